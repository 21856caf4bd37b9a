// SPDX-License-Identifier: MIT
// Says how a run gets on: one line that is redrawn on a terminal, a plain line every ten seconds elsewhere, or nothing.
// Reads the clock for display only; nothing that the run decides depends on it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

namespace clast {

/// What a run shows of itself.
struct progress_state {
    std::string_view stage;     ///< name of the running stage
    double fraction = 0.0;      ///< part of the stage that is done, 0 to 1
    double run_fraction = -1.0; ///< part of the whole run that is done, 0 to 1; negative where nobody knows
    std::string_view measure;   ///< what the stage waits for, with its value, e.g. "eps_a 12.3 %"
    double q = 0.0;             ///< deviatoric stress (Pa)
    std::int64_t steps = 0;     ///< steps so far
};

namespace detail {

/// "1:05" or "2:03:09"; "--:--" for what is not known.
inline std::string clock_text(double seconds) {
    if (!(seconds >= 0.0) || seconds > 3.6e6) return "--:--";
    const auto s = std::llround(seconds);
    return s < 3600 ? fmt::format("{}:{:02}", s / 60, s % 60)
                    : fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

/// A bar of `width` characters; in UTF-8 its end is drawn in eighths.
inline std::string bar_text(double fraction, int width, bool utf8) {
    const double f = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
    const int eighths = static_cast<int>(f * width * 8 + 1e-9);
    constexpr std::string_view part[] = {"", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
    std::string bar;
    for (int i = 0; i < eighths / 8; ++i) bar += utf8 ? "█" : "#";
    int drawn = eighths / 8;
    if (utf8 && eighths % 8 != 0) {
        bar += part[eighths % 8];
        ++drawn;
    }
    return bar.append(static_cast<std::size_t>(width - drawn), utf8 ? ' ' : '.');
}

} // namespace detail

/// Time left (s) from the part that was done since the clock started; negative where nothing can be said yet.
/// A resumed run starts at `first_fraction` > 0, which must not count as done in no time.
inline double time_left(double first_fraction, double fraction, double elapsed) {
    const double done = fraction - first_fraction;
    return done > 0.0 && elapsed > 0.0 ? (1.0 - fraction) * elapsed / done : -1.0;
}

/// One line of progress. `bar_width` 0 and a negative speed are left out; `eta` (s) negative: not known.
inline std::string progress_line(const progress_state& s, double elapsed, double steps_per_second, double eta,
                                 int bar_width, bool utf8) {
    std::string line = fmt::format("{:<12.12}", s.stage);
    if (bar_width > 0)
        line += utf8 ? fmt::format(" ▕{}▏", detail::bar_text(s.fraction, bar_width, utf8))
                     : fmt::format(" [{}]", detail::bar_text(s.fraction, bar_width, utf8));
    line += fmt::format(" {:3.0f} %", 100.0 * (std::isfinite(s.fraction) ? std::clamp(s.fraction, 0.0, 1.0) : 0.0));
    if (!s.measure.empty()) line += fmt::format("  {}", s.measure);
    line += fmt::format("  q {:.2f} MPa", s.q / 1e6);
    if (steps_per_second >= 1e4)
        line += fmt::format("  {:.1f}k steps/s", steps_per_second / 1e3);
    else if (steps_per_second >= 0.0)
        line += fmt::format("  {:.0f} steps/s", steps_per_second);
    line += fmt::format("  {}", detail::clock_text(elapsed));
    return line + (eta >= 0.0 ? fmt::format("  ETA {}", detail::clock_text(eta)) : std::string("  ETA --:--"));
}

/// Draws progress on a stream. Call update() as often as convenient: it draws at most ten times a second (terminal) or
/// once in ten seconds (file, pipe), and keeps quiet where `quiet` is set.
class progress {
  public:
    explicit progress(bool quiet, std::FILE* stream = stderr) : stream_(quiet ? nullptr : stream) {
        if (!stream_) return;
        terminal_ = ::isatty(::fileno(stream_)) != 0;
        for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"})
            if (const char* value = std::getenv(name); value && *value) {
                const std::string_view locale(value);
                utf8_ = locale.find("UTF-8") != locale.npos || locale.find("utf8") != locale.npos;
                break;
            }
        start_ = last_rate_ = clock::now();
        next_ = start_;
    }
    progress(const progress&) = delete;
    progress& operator=(const progress&) = delete;
    ~progress() { clear(); }

    /// Shows the state if it is time to.
    void update(const progress_state& s) {
        if (!stream_) return;
        const auto now = clock::now();
        if (stage_ != s.stage) {
            if (!stage_.empty() && terminal_) std::fputs("\n", stream_); // the finished stage stays on the screen
            stage_ = s.stage;
            stage_start_ = now;
            stage_first_ = s.fraction;
            next_ = now;
        }
        if (first_run_fraction_ < 0.0) first_run_fraction_ = s.run_fraction;
        if (now < next_) return;
        next_ = now + (terminal_ ? std::chrono::milliseconds(100) : std::chrono::seconds(10));

        const double since = seconds(now - last_rate_);
        if (last_steps_ < 0 || since > 1.0) {
            if (last_steps_ >= 0) rate_ = std::max(0.0, static_cast<double>(s.steps - last_steps_) / since);
            last_steps_ = s.steps;
            last_rate_ = now;
        }
        const bool whole = s.run_fraction >= 0.0;
        const double eta = whole ? time_left(first_run_fraction_, s.run_fraction, seconds(now - start_))
                                 : time_left(stage_first_, s.fraction, seconds(now - stage_start_));
        if (!terminal_) {
            fmt::print(stream_, "{}\n", progress_line(s, seconds(now - start_), rate_, eta, 0, utf8_));
        } else {
            // the widest text so far decides, or the bar would change its width with every digit
            const auto text = [&](double speed, int bar) {
                return progress_line(s, seconds(now - start_), speed, eta, bar, utf8_);
            };
            widest_ = std::max(widest_, static_cast<int>(text(rate_, 0).size()));
            widest_without_speed_ = std::max(widest_without_speed_, static_cast<int>(text(-1.0, 0).size()));
            const bool speed = columns() - widest_ - 5 >= 10;
            const int bar = std::min(columns() - (speed ? widest_ : widest_without_speed_) - 5, 28);
            std::string line = text(speed ? rate_ : -1.0, bar >= 4 ? bar : 0);
            // a line that is longer than the screen would wrap and could not be redrawn
            if (bar < 4) line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(columns() - 1, 10))));
            fmt::print(stream_, "\r\x1b[K{}", line);
            drawn_ = true;
        }
        std::fflush(stream_);
    }

    /// Prints a line of text above the bar, e.g. "checkpoint written"; nothing in quiet mode.
    void note(std::string_view text) {
        if (!stream_) return;
        fmt::print(stream_, "{}{}\n", terminal_ && drawn_ ? "\r\x1b[K" : "", text);
        drawn_ = false;
        next_ = clock::now();
        std::fflush(stream_);
    }

    /// Leaves the last line on the screen and goes to the next one. Called by the destructor too.
    void clear() {
        if (stream_ && drawn_) std::fputs("\n", stream_);
        drawn_ = false;
    }

  private:
    using clock = std::chrono::steady_clock;
    static double seconds(clock::duration d) { return std::chrono::duration<double>(d).count(); }
    [[nodiscard]] int columns() const {
        winsize size{};
        return ::ioctl(::fileno(stream_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
    }

    std::FILE* stream_ = nullptr;
    bool terminal_ = false;
    bool utf8_ = false;
    bool drawn_ = false;
    int widest_ = 0;
    int widest_without_speed_ = 0;
    std::string stage_;
    clock::time_point start_, stage_start_, last_rate_, next_;
    double stage_first_ = 0.0;
    double first_run_fraction_ = -1.0;
    double rate_ = 0.0;
    std::int64_t last_steps_ = -1;
};

} // namespace clast
