// The least of numbers that are taken out one after another.
#pragma once

#include <algorithm>
#include <array>

#include "problem/instance.h"

namespace tandem {

// Knows the least of each block, so that to find the least of all takes the time of their root.
class Least {
public:
    // The first `count` of some numbers.
    Least(View<double, 1> numbers, Int count)
        : numbers_(numbers),
          count_(count),
          length_(std::max(shortest, (count + most_blocks - 1) / most_blocks)) {
        if (count_ > few) {
            for (Int block = 0; block * length_ < count_; ++block) note(block);
        }
    }

    // Where the first of the least numbers is.
    Int first() const {
        if (count_ <= few) {
            return std::min_element(numbers_.begin(), numbers_.begin() + count_) - numbers_.begin();
        }
        const auto least = std::min_element(least_.begin(), least_.begin() + blocks());
        const Int begin = (least - least_.begin()) * length_;
        return std::find(numbers_.begin() + begin, numbers_.end(), *least) - numbers_.begin();
    }

    // Take a number out; the last is put in its place.
    void take_out(Int index) {
        numbers_[index] = numbers_[--count_];
        if (count_ <= few) return;
        if (count_ % length_ != 0) note(count_ / length_);
        if (index < count_) note(index / length_);
    }

private:
    static constexpr Int most_blocks = 128;
    static constexpr Int shortest = 16;
    static constexpr Int few = 32;  // that are all looked at

    Int blocks() const { return (count_ + length_ - 1) / length_; }

    void note(Int block) {
        const double* begin = numbers_.begin() + block * length_;
        const double* end = numbers_.begin() + std::min(count_, (block + 1) * length_);
        least_[static_cast<std::size_t>(block)] = *std::min_element(begin, end);
    }

    View<double, 1> numbers_;
    Int count_;
    Int length_;
    std::array<double, most_blocks> least_;
};

}  // namespace tandem
