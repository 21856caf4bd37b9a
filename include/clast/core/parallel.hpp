// SPDX-License-Identifier: MIT
// Loops whose result does not depend on the number of threads, nor on who else uses the machine.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <thread>
#include <type_traits>
#include <vector>

namespace clast {

/// Number of threads that this machine runs side by side.
inline int available_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

namespace detail {

/// Threads that help with one loop at a time. A loop is cut into chunks that whoever is awake takes; the caller takes
/// them, too, and waits only for chunks that a helper has begun. So a helper that the system does not let run costs
/// nothing, where a barrier of all threads (as OpenMP has at the end of a loop) would wait for it: with one of two
/// cores taken by another program, steps of 0.3 ms took 3 to 5 ms behind such barriers.
class helpers {
  public:
    explicit helpers(int count) {
        for (int i = 0; i < count; ++i)
            threads_.emplace_back([this, i] { help(i % 2 == 0 ? side::back : side::front); });
    }
    ~helpers() {
        ticket_.store(stop, std::memory_order_seq_cst);
        ticket_.notify_all();
        for (std::thread& t : threads_) t.join();
    }
    helpers(const helpers&) = delete;
    helpers& operator=(const helpers&) = delete;

    using chunk_function = void (*)(void* context, std::size_t chunk) noexcept; // a loop cannot be left half-way

    void run(std::size_t chunks, chunk_function f, void* context) {
        f_ = f, context_ = context;
        done_.store(0, std::memory_order_relaxed);
        ++generation_;
        // generation, end and begin of the chunks that are left in one word: a helper that is late cannot take a chunk
        // of a loop it has not seen
        ticket_.store((generation_ & 0xffffff) << 40 | static_cast<std::uint64_t>(chunks) << 20,
                      std::memory_order_seq_cst);
        if (sleepers_.load(std::memory_order_seq_cst) > 0) ticket_.notify_all();
        while (take(side::front)) {
        }
        wait_while([&] { return done_.load(std::memory_order_acquire) < chunks; }, [] { return true; });
    }

  private:
    static constexpr std::uint64_t stop = ~std::uint64_t{0};
    static constexpr std::uint64_t mask = 0xfffff, one_less_at_end = std::uint64_t{1} << 20;
    /// From which end a thread takes chunks: what it had in the last loop over the same things is in its cache.
    enum class side { front, back };

    static std::uint64_t begin(std::uint64_t t) { return t & mask; }
    static std::uint64_t end(std::uint64_t t) { return t >> 20 & mask; }

    /// Takes and does one chunk; false if none is left.
    bool take(side from) {
        std::uint64_t t = ticket_.load(std::memory_order_acquire), left;
        do {
            if (begin(t) >= end(t)) return false;
            left = from == side::front ? t + 1 : t - one_less_at_end;
        } while (!ticket_.compare_exchange_weak(t, left, std::memory_order_acq_rel, std::memory_order_acquire));
        // the caller cannot begin another loop before this is done
        f_(context_, static_cast<std::size_t>(from == side::front ? begin(t) : end(t) - 1));
        done_.fetch_add(1, std::memory_order_release);
        return true;
    }

    /// Waits while waiting() and patient() hold: awake first, then so that others may have the core. Returns waiting().
    template <class Waiting, class Patient> static bool wait_while(Waiting&& waiting, Patient&& patient) {
        for (int spin = 0; waiting(); ++spin) {
            if (spin < 1000) {
#if defined(__x86_64__) || defined(__i386__)
                __builtin_ia32_pause();
#endif
                continue;
            }
            if (!patient()) return true;
            std::this_thread::yield();
        }
        return false;
    }

    void help(side from) {
        for (;;) {
            std::uint64_t seen = ticket_.load(std::memory_order_acquire);
            if (seen == stop) return;
            if (take(from)) continue;
            // loops follow each other within microseconds, and to be woken takes tens of them
            const auto since = std::chrono::steady_clock::now();
            const auto recently = [&] {
                return std::chrono::steady_clock::now() - since < std::chrono::milliseconds(1);
            };
            if (!wait_while([&] { return ticket_.load(std::memory_order_relaxed) == seen; }, recently)) continue;
            sleepers_.fetch_add(1, std::memory_order_seq_cst);
            ticket_.wait(seen, std::memory_order_seq_cst);
            sleepers_.fetch_sub(1, std::memory_order_seq_cst);
        }
    }

    std::atomic<std::uint64_t> ticket_{0};
    std::atomic<std::size_t> done_{0};
    std::atomic<int> sleepers_{0};
    std::uint64_t generation_ = 0;
    chunk_function f_ = nullptr;
    void* context_ = nullptr;
    std::vector<std::thread> threads_;
};

} // namespace detail

/// How loops are run. Every loop below gives the same bits for any number of threads. Copies share their threads; one
/// loop at a time.
class execution {
  public:
    /// threads >= 1, the calling one included.
    explicit execution(int threads = 1)
        : threads_(std::max(1, threads)),
          helpers_(threads > 1 ? std::make_shared<detail::helpers>(threads - 1) : nullptr) {}

    int threads() const { return threads_; }

    /// body(i) for i in [0, n). Iterations must not depend on each other. `grain`: iterations worth handing to another
    /// thread (about a microsecond of work or more); shorter loops stay on the calling thread.
    template <class F> void for_each(std::size_t n, F&& body, std::size_t grain = 64) const {
        if (helpers_ == nullptr || n < 2 * grain) {
            do_span(body, 0, n);
            return;
        }
        const std::size_t pieces = static_cast<std::size_t>(threads_) * 8;
        struct loop {
            F* body;
            std::size_t n, chunk;
        } l{&body, n, std::max({grain, (n + pieces - 1) / pieces, (n >> 19) + 1})};
        helpers_->run((n + l.chunk - 1) / l.chunk,
                      [](void* context, std::size_t c) noexcept {
                          const loop& me = *static_cast<const loop*>(context);
                          do_span(*me.body, c * me.chunk, std::min(me.n, (c + 1) * me.chunk));
                      },
                      &l);
    }

    /// Sum of value(i) over [0, n) in a fixed order: chunks of 256 are summed one by one, then the partial sums.
    template <class T, class F> T sum(std::size_t n, T zero, F&& value) const {
        std::vector<T> partial(chunks(n), zero);
        for_each(
            partial.size(),
            [&](std::size_t c) {
                T s = zero;
                for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) s += value(i);
                partial[c] = s;
            },
            1);
        T total = zero;
        for (const T& s : partial) total += s;
        return total;
    }

    /// Largest value(i) over [0, n), at least `floor`. value(i, so_far) may answer so_far, the largest known to its
    /// thread, where it knows that its own is not larger.
    template <class F> double max(std::size_t n, double floor, F&& value) const {
        std::vector<double> partial(chunks(n), floor);
        for_each(
            partial.size(),
            [&](std::size_t c) {
                double largest = floor;
                for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i)
                    if constexpr (std::is_invocable_v<F, std::size_t, double>)
                        largest = std::max(largest, value(i, largest));
                    else
                        largest = std::max(largest, value(i));
                partial[c] = largest;
            },
            1);
        double largest = floor;
        for (double v : partial) largest = std::max(largest, v);
        return largest;
    }

    /// The i in [0, n) for which wanted(i), ascending. Every i is asked once.
    template <class Index = std::uint32_t, class F> std::vector<Index> where(std::size_t n, F&& wanted) const {
        const auto found = std::make_unique_for_overwrite<Index[]>(n); // from the start of each chunk on
        std::vector<std::size_t> start(chunks(n) + 1, 0);
        constexpr std::size_t grain = 4;
        for_each(
            chunks(n),
            [&](std::size_t c) {
                Index* to = found.get() + c * chunk;
                std::size_t count = 0;
                for (std::size_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) {
                    to[count] = static_cast<Index>(i); // no branch on what may be anything
                    count += wanted(i) ? 1U : 0U;
                }
                start[c + 1] = count;
            },
            grain);
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<Index> all(start.back());
        for_each(
            chunks(n),
            [&](std::size_t c) {
                std::copy_n(found.get() + c * chunk, start[c + 1] - start[c], all.data() + start[c]);
            },
            grain);
        return all;
    }

  private:
    /// The one place where a body is compiled: in two copies, one for one thread and one for several, a compiler might
    /// contract a*b + c in one and not in the other, and the bits would differ.
    template <class F> [[gnu::noinline]] static void do_span(F& body, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) body(i);
    }

    static constexpr std::size_t chunk = 256;
    static std::size_t chunks(std::size_t n) { return (n + chunk - 1) / chunk; }

    int threads_;
    std::shared_ptr<detail::helpers> helpers_;
};

} // namespace clast
