// Where exceptions end: functions of the C interface return codes.
#pragma once

#include <exception>
#include <new>

namespace tandem {

enum Code : int { done = 0, out_of_memory = -1, failed = -2, ended = -3 };

// Thrown by what was told to end before there was anything to show for it.
class Ended : public std::exception {};

// Run what may throw; return 0, or what it threw as a code.
template <class F>
int guarded(F&& run) {
    try {
        run();
        return done;
    } catch (const std::bad_alloc&) {
        return out_of_memory;
    } catch (const Ended&) {
        return ended;
    } catch (...) {
        return failed;
    }
}

}  // namespace tandem
