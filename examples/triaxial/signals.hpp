// SPDX-License-Identifier: MIT
// Ctrl-C and SIGTERM as a flag that the run loop polls, so that a run ends with a checkpoint and not in the middle of
// one.
#pragma once

#include <atomic>
#include <csignal>

namespace triaxial {

namespace detail {
inline std::atomic<int> stop_signal{0};
static_assert(std::atomic<int>::is_always_lock_free); // else a handler must not touch it
} // namespace detail

/// The signal that asked the run to stop (SIGINT, SIGTERM), 0 if none did. The program then ends with code 128 +
/// signal.
inline int requested_stop() { return detail::stop_signal.load(std::memory_order_relaxed); }

/// Catches SIGINT and SIGTERM. A second one ends the program at once.
inline void catch_stop_signals() {
    struct sigaction action {};
    action.sa_handler = [](int signal) { detail::stop_signal.store(signal, std::memory_order_relaxed); };
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

} // namespace triaxial
