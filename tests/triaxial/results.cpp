// SPDX-License-Identifier: MIT
// The folder of results of examples/triaxial, compiled into this test.
#include "../../examples/triaxial/results.cpp"

#include <catch.hpp>

using namespace triaxial;

namespace {

struct folder {
    fs::path path = fs::temp_directory_path() / fmt::format("clast_results_test_{}", ::getpid());
    folder() { fs::create_directories(path); }
    ~folder() { fs::remove_all(path); }
    options run() const {
        options o;
        o.out = path / "run";
        o.plots = false;
        return o;
    }
};

// shear to 25 % in 500 rows after a consolidation
std::vector<sample> some_rows() {
    std::vector<sample> rows;
    for (int i = 0; i < 3; ++i) {
        sample s;
        s.stage = "consolidate";
        s.time = 0.1 * i;
        s.steps = 10 * i;
        s.wall_time = i;
        s.broken_tension = i;
        s.energy_residual = -9.0; // counts in shear only
        rows.push_back(s);
    }
    for (int i = 0; i <= 500; ++i) {
        sample s = rows[2];
        const double e = 0.25 * i / 500;
        s.stage = "shear";
        s.time = 0.2 + 0.01 * i;
        s.steps = 20 + 5 * i;
        s.wall_time = 2 + 0.1 * i;
        s.axial_strain = e;
        s.q = 1e6 * (4.0 - 400.0 * (e - 0.1) * (e - 0.1)); // peak 4 MPa at 10 %
        s.sigma_3 = 2e6;
        s.p = 2e6 + s.q / 3.0;
        s.q_contacts = (i == 50 ? 1.02 : e < 0.2 ? 1.004 : 1.01) * s.q;               // the last fifth begins at 20 %
        s.phi_mob_deg = 40.0 - 1000.0 * (e - 0.1) * (e - 0.1) + (i % 2 ? 1.0 : -1.0); // a ripple from row to row
        s.void_ratio = 1.4 + 10.0 * (e - 0.05) * (e - 0.05);
        s.confining_error = i == 250 ? 0.02 : i == 0 ? 5.0 : 0.001;
        s.energy_residual = i == 100 ? -0.004 : 0.001;
        s.broken_tension = 2 + i;
        s.replaced = i / 2;
        rows.push_back(s);
    }
    return rows;
}

std::vector<clast::pebble_view> pebbles() {
    return {{{0.1, 0.2, 0.3}, 0.01, 3, 4, clast::pebble_state::bonded, {1, 2, 3}, {4, 5, 6}}};
}
std::string text_of(const fs::path& p) { return clast::detail::read_whole(p); }

} // namespace

TEST_CASE("the summary finds peak, friction angle after averaging, void ratio, errors and stage times") {
    const summary_numbers n = summarise(some_rows());
    REQUIRE(n.sheared);
    REQUIRE(n.peak_q.value == Approx(4e6).epsilon(1e-12));
    REQUIRE(n.peak_q.axial_strain == Approx(0.1).epsilon(1e-12));
    REQUIRE(n.peak_q.p == Approx(2e6 + 4e6 / 3).epsilon(1e-12));
    // five rows of 0.05 % fall into the window of 0.2 %: the ripple of 1 degree falls to 1/5
    const double spread = 1000.0 * 2.0 * (0.0005 * 0.0005 + 0.001 * 0.001) / 5.0;
    REQUIRE(n.phi_max.value <= 40.2);
    REQUIRE(n.phi_max.value == Approx(40.2 - spread).margin(5e-4));
    REQUIRE(n.e_min.value == Approx(1.4).epsilon(1e-12));
    REQUIRE(n.e_min.axial_strain == Approx(0.05).epsilon(1e-12));
    REQUIRE(n.e_start == Approx(1.425).epsilon(1e-12));
    REQUIRE(n.peak_q_contacts == Approx(1.004 * 4e6).epsilon(1e-12));
    REQUIRE(n.contacts_over_q == Approx(1.01).epsilon(1e-12));
    REQUIRE(n.max_q_mismatch == Approx(0.02).epsilon(1e-9));
    REQUIRE(n.mean_confining_error == Approx((499 * 0.001 + 0.02) / 500).epsilon(1e-12));
    REQUIRE(n.max_confining_error == 0.02);
    REQUIRE(n.max_energy_residual == 0.004);
    REQUIRE(n.broken_in_shear == 500);
    REQUIRE(n.broken_tension == 502);
    REQUIRE(n.stages.size() == 2);
    REQUIRE(n.stages[1].name == "shear");
    REQUIRE(n.stages[1].steps == 2500);
    REQUIRE(n.stages[1].model_time == Approx(5.0).epsilon(1e-12));
    REQUIRE(n.stages[1].wall_time == Approx(50.0).epsilon(1e-12));
}

TEST_CASE("a run without shear, or without rows, has a summary too") {
    REQUIRE(!summarise({}).sheared);
    const auto rows = some_rows();
    REQUIRE(!summarise(std::span(rows).first(3)).sheared);
    REQUIRE(summarise(std::span(rows).first(4)).stages.size() == 2);
}

TEST_CASE("a resumed folder equals an uninterrupted one") {
    const folder f;
    options o = f.run();
    const auto rows = some_rows();
    const auto write = [&](result_folder& r, std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            r.row(rows[i]);
            clast::fracture_event e;
            e.time = rows[i].time;
            r.events({&e, 1});
            if (i % 10 == 0) r.snapshot(rows[i].time, pebbles(), {});
        }
    };
    const auto contents = [&] {
        return text_of(o.out / "series.csv") + text_of(o.out / "events.csv") + text_of(o.out / "vtk" / "pebbles.pvd") +
               text_of(o.out / "vtk" / "boundary.pvd");
    };
    {
        result_folder whole(o);
        write(whole, 0, 60);
    }
    const std::string uninterrupted = contents();
    o.overwrite = true;
    for (const std::size_t stop : {0u, 1u, 30u, 31u, 59u, 60u}) {
        result_position at;
        {
            result_folder first(o);
            write(first, 0, stop);
            at = first.position();
            write(first, stop,
                  std::min<std::size_t>(stop + 13, 60)); // went on after its last checkpoint, then was killed
        }
        result_folder second(o, at);
        REQUIRE(second.position().rows == static_cast<std::int64_t>(stop));
        write(second, stop, 60);
        REQUIRE(contents() == uninterrupted);
    }
    REQUIRE_THROWS_AS(result_folder(o, result_position{61, 60, 6}), input_error); // rows were lost
}

TEST_CASE("results are never overwritten unasked, and only what a run wrote is ever removed") {
    const folder f;
    options o = f.run();
    {
        result_folder r(o);
        r.row(some_rows()[0]);
    }
    const std::string before = text_of(o.out / "series.csv");
    clast::detail::replace_file(o.out / "notes.txt", {"mine"});
    REQUIRE_THROWS_AS(result_folder(o), input_error);
    REQUIRE(text_of(o.out / "series.csv") == before);
    o.overwrite = true;
    { result_folder r(o); }
    REQUIRE(text_of(o.out / "series.csv") != before);
    REQUIRE(text_of(o.out / "notes.txt") == "mine");
}

TEST_CASE("the views for the figures survive on disk") {
    const folder f;
    const options o = f.run();
    result_folder r(o);
    specimen_view view{0.1, pebbles(), {{{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 1}}}, 5.0, 6.0, 7, 8}}};
    r.start_of_shear(view);
    stored_view back;
    clast::load_checkpoint(o.out / "plots" / "data" / "view_start.bin", view_fingerprint, back);
    REQUIRE(back.view.axial_strain == 0.1);
    REQUIRE(back.view.pebbles.size() == 1);
    REQUIRE(back.view.pebbles[0].velocity == clast::vec3{4, 5, 6});
    REQUIRE(back.view.pebbles[0].state == clast::pebble_state::bonded);
    REQUIRE(back.view.facets.size() == 1);
    REQUIRE(back.view.facets[0].corner[2] == clast::vec3{7, 8, 9});
    REQUIRE(back.view.facets[0].tile == 8);
}

TEST_CASE("deep overlaps are told, in the middle from a tenth of the radius on and at most from a half on") {
    std::vector<sample> rows = some_rows();
    rows[1].median_overlap_over_r = 0.11; // before the shear: no number of a row is left out
    rows[300].max_overlap_over_r = 0.62;
    const summary_numbers n = summarise(rows);
    REQUIRE(n.median_overlap_over_r == 0.11);
    REQUIRE(n.max_overlap_over_r == 0.62);
    const std::vector<std::string> said = remarks(n);
    REQUIRE(said.size() == 2);
    REQUIRE(said[0].starts_with("note: half of all contacts overlap by more than 0.11"));
    REQUIRE(said[1].starts_with("warning: the largest overlap was 0.62"));
    summary_numbers fine = n;
    fine.median_overlap_over_r = 0.1, fine.max_overlap_over_r = 0.5;
    REQUIRE(remarks(fine).empty());
}

namespace {

/// Compaction that fell short, relaxation, consolidation that passed its stress by 1 %, and shear.
std::vector<clast::stage_record> some_records() {
    return {{"compact", "jammed short of 'target size'", false, 14e3, 13e3, 0.0, 4.3, 0.59, 0.1, 70000},
            {"relax", "coordination < 1", true, 12e3, 2.0, 0.05, 0.9, 0.59, 30.0, 1100},
            {"consolidate", "stress error < 0.1 %", true, 2.02e6, 1.999e6, 0.3, 5.2, 0.56, 5e-4, 40000},
            {"shear", "axial strain 25 %", true, 3e6, 3e6, 0.3, 5.5, 0.55, 1e-3, 200000}};
}

} // namespace

TEST_CASE("the preparation is what came before consolidation, overconsolidation what came before shear") {
    const auto records = some_records();
    preparation_numbers n = preparation_of(records, 2e6);
    REQUIRE(n.largest_p_before_consolidation == 14e3);
    REQUIRE(n.overconsolidation_ratio == Approx(1.01)); // not of the 3 MPa in shear
    REQUIRE(n.friction == 0.0);
    REQUIRE(n.at_rest->name == "relax");
    REQUIRE(n.at_stress->porosity == 0.56);
    n = preparation_of(std::span(records).first(2), 2e6);
    REQUIRE(n.at_rest->porosity == 0.59);
    REQUIRE_FALSE(n.at_stress.has_value());
    REQUIRE_FALSE(preparation_of({}, 2e6).at_rest.has_value());
}

TEST_CASE("summary.json holds inputs, machine, numbers and checksum") {
    const folder f;
    const options o = f.run();
    result_folder r(o);
    for (const sample& s : some_rows()) r.row(s);
    run_facts facts;
    facts.grains = 50;
    facts.checksum = 0xabcULL;
    facts.more = {{"grain_step_s", 1e-5}};
    facts.stages = some_records();
    facts.stages.erase(facts.stages.begin(), facts.stages.begin() + 2); // rows begin with the consolidation
    r.finish(facts);
    const auto j = nlohmann::json::parse(text_of(o.out / "summary.json"));
    REQUIRE(j["inputs"]["shape"] == "4B");
    REQUIRE(j["inputs"]["confining_stress_Pa"] == 2000000);
    REQUIRE(j["inputs"]["bond_stiffness_N_per_m"] == 9.6e8);
    REQUIRE(j["inputs"]["seed"].is_number_unsigned());
    REQUIRE(j["inputs"]["axial_strain"] == 0.25);
    REQUIRE(j["inputs"]["protocol"] == "triaxial");
    REQUIRE(j["finished"] == true);
    REQUIRE_FALSE(j.contains("unfinished"));
    REQUIRE(j["specimen"]["grains"] == 50);
    REQUIRE(j["shear"]["peak_q_Pa"].get<double>() == Approx(4e6));
    REQUIRE(j["shear"]["q_contacts_over_q_last_fifth_of_strain"].get<double>() == Approx(1.01));
    REQUIRE(j["overlap"]["max_over_r"] == 0.0);
    REQUIRE(j["remarks"].empty());
    REQUIRE(j["stages"].size() == 2);
    REQUIRE(j["stages"][0]["ended_by"] == "stress error < 0.1 %");
    REQUIRE(j["stages"][0]["reached_its_condition"] == true);
    REQUIRE(j["stages"][0]["largest_p_Pa"] == 2.02e6);
    REQUIRE(j["stages"][0]["least_friction"] == 0.3);
    REQUIRE(j["stages"][1]["ended_by"] == "axial strain 25 %");
    REQUIRE(j["stages"][1]["coordination_at_end"] == 5.5);
    REQUIRE(j["preparation"]["overconsolidation_ratio"].get<double>() == Approx(1.01));
    REQUIRE(j["preparation"]["at_confining_stress"]["porosity"] == 0.56);
    REQUIRE_FALSE(j["preparation"].contains("at_rest"));
    REQUIRE(j["more"]["grain_step_s"] == 1e-5);
    REQUIRE(j["final_state_checksum"] == "0000000000000abc");
    REQUIRE(j["machine"].contains("cpu"));
}

TEST_CASE("a run that was stopped by an error has its summary, and says that it is unfinished, and why") {
    const folder f;
    const options o = f.run();
    result_folder r(o);
    for (const sample& s : some_rows()) r.row(s);
    run_facts facts;
    facts.stages = some_records();
    facts.stages.resize(3); // the shear has not ended
    facts.stopped_by = clast::failure{"The membrane is torn", "tile 3", "step 7", "too fast", "load more slowly"};
    r.finish(facts);
    const auto j = nlohmann::json::parse(text_of(o.out / "summary.json"));
    REQUIRE(j["finished"] == false);
    REQUIRE(j["unfinished"]["what"] == "The membrane is torn");
    REQUIRE(j["unfinished"]["when"] == "step 7");
    REQUIRE(j["shear"]["peak_q_Pa"].get<double>() == Approx(4e6)); // of what there is
}

TEST_CASE("the energy residual counts where the stage has done some work, not at turning points") {
    std::vector<sample> rows;
    const auto add = [&](const char* stage, double work, double residual) {
        sample s;
        s.stage = stage, s.boundary_work = work, s.energy_residual = residual;
        s.axial_strain = 0.001 * static_cast<double>(rows.size());
        rows.push_back(s);
    };
    add("shear", 100.0, 0.0);
    add("shear", 100.5, 3.0); // 0.5 J of 50
    add("shear", 150.0, -0.004);
    add("unload", 150.0, 0.0);
    add("unload", 149.6, 2.0);
    add("unload", 140.0, 0.003);
    REQUIRE(summarise(rows).max_energy_residual == 0.004);
    add("unload", 139.0, -0.01);
    REQUIRE(summarise(rows).max_energy_residual == 0.01);
}
