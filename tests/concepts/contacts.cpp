// SPDX-License-Identifier: MIT
#include <clast/contacts/concepts.hpp>

#include <type_traits>

#include <catch.hpp>

using namespace clast;

namespace {

/// The poorest contact law: plain double, no history, no default constructor, nothing but what the concept asks.
struct archetype {
    struct history {};
    explicit archetype(double k) : stiffness(k) {}
    contacts::response<double> operator()(const contacts::overlap<double>& o, const contacts::motion<double>&, history&,
                                          double) const {
        const double f = -stiffness * o.depth;
        return {f * o.nx, f * o.ny, f * o.nz, 0.0};
    }
    float stored(const contacts::overlap<double>&, const history&) const { return 0.0F; } // converts to double
    double normal_stiffness(const contacts::overlap<double>&) const { return stiffness; }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }

  private:
    double stiffness;
};

struct not_const : archetype {
    contacts::response<double> operator()(const contacts::overlap<double>&, const contacts::motion<double>&, history&,
                                          double) {
        return {};
    }
};

struct without_energy {
    struct history {};
    contacts::response<double> operator()(const contacts::overlap<double>&, const contacts::motion<double>&, history&,
                                          double) const {
        return {};
    }
    double normal_stiffness(const contacts::overlap<double>&) const { return 1.0; }
    double shear_stiffness(const contacts::overlap<double>&) const { return 0.0; }
};

/// A history that owns memory cannot be copied byte by byte into a checkpoint.
struct owning : archetype {
    struct history {
        ~history() {}
    };
    contacts::response<double> operator()(const contacts::overlap<double>&, const contacts::motion<double>&, history&,
                                          double) const {
        return {};
    }
    double stored(const contacts::overlap<double>&, const history&) const { return 0.0; }
};

static_assert(contacts::contact_law<archetype>);
static_assert(!std::is_default_constructible_v<archetype>);
static_assert(!contacts::contact_law<not_const>);
static_assert(!contacts::contact_law<without_energy>);
static_assert(!contacts::contact_law<owning>);
static_assert(!contacts::contact_law<int>);

} // namespace

TEST_CASE("the poorest contact law answers with a force") {
    const archetype law(10.0);
    archetype::history h;
    CHECK(law({0, 0, 1, 0.5, 1, 1}, {}, h, 1e-5).fz == -5.0);
}
