// SPDX-License-Identifier: MIT
// What a runner reports to, and what looks at the scene itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <clast/engine/scene.hpp>
#include <clast/measure/sample.hpp>
#include <clast/protocol/vessel.hpp>

namespace clast {

/// What a runner reports to. Derive and override what you need; called once in many steps, never per contact.
class observer {
  public:
    virtual ~observer() = default;
    virtual void on_row(const sample&) {}                         ///< one row of the series
    virtual void on_events(const std::vector<fracture_event>&) {} ///< bonds broken since the last call
    /// A stage begins, before its first row, or has ended, after its last.
    virtual void on_stage(const std::string& /*name*/, bool /*begins*/) {}
    /// What the one who reads the results should know: a stage that went on short of its end.
    virtual void on_note(const std::string&) {}
    virtual void on_progress(const sample&, double /*of the stage*/, double /*of the test*/) {}
    /// Between two steps, with all events reported: the place to save a checkpoint.
    virtual void on_pause() {}
    virtual bool stop_requested() { return false; } ///< true: run() returns at the next pause
};

/// An observer that looks at the scene itself: bodies, contacts, loads. It can change nothing. All pebbles stand where
/// they are, also those that touch nothing. What it finds out at rows or steps it keeps itself.
template <triaxial_policies P> class scene_observer : public observer {
  public:
    /// With every row, after on_row.
    virtual void on_scene(const scene<P>&, const sample&) {}
    /// Steps between two calls of on_step, counted from the beginning of the run, stopped and resumed or not; 0: none.
    virtual std::int64_t every_steps() const { return 0; }
    virtual void on_step(const scene<P>&) {} ///< after a step whose number is a multiple of every_steps()
};

} // namespace clast
