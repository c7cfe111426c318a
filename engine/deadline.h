// When work has to end: at an instant, or once whoever asked for it wants no more.
#pragma once

#include <ctime>

#include "guard.h"
#include "view.h"

namespace tandem {

// Belongs to one thread, which asks it between small parts of its work. Whether the work is wanted
// is looked at each time, and the clock, which takes as long as some of these parts, now and then.
class Deadline {
public:
    // What Python writes (`model.engine.alarm`): not 0 once nobody wants more, at any time and from
    // any thread; the last instant in nanoseconds; and the clock that tells it, `CLOCK_MONOTONIC`
    // but where measurements are by the processor time of the process.
    explicit Deadline(View<const std::int64_t, 1> alarm) : alarm_(alarm.data()) {}

    // Whether work has to end; from then on it always has.
    bool passed() const {
        if (passed_) return true;
        if (is_cancelled()) return passed_ = true;
        if (--calls_ > 0) return false;
        calls_ = calls_between_looks;
        return passed_ = now() >= alarm_[last_instant];
    }

    // Ends, by `Ended`, what is of no use but as a whole.
    void go_on() const {
        if (passed()) throw Ended{};
    }

    // The same, but where it is of more use late than never, only if nobody wants it any more.
    void go_on_late() const {
        if (is_cancelled()) throw Ended{};
    }

private:
    static constexpr int cancelled = 0, last_instant = 1, clock = 2;
    // Of parts that take a millisecond at most, so that the clock is looked at every 16.
    static constexpr int calls_between_looks = 16;

    bool is_cancelled() const { return __atomic_load_n(&alarm_[cancelled], __ATOMIC_RELAXED) != 0; }

    std::int64_t now() const {
        timespec time;
        clock_gettime(static_cast<clockid_t>(alarm_[clock]), &time);
        return time.tv_sec * std::int64_t{1'000'000'000} + time.tv_nsec;
    }

    const std::int64_t* alarm_;
    mutable int calls_ = 1;
    mutable bool passed_ = false;
};

}  // namespace tandem
