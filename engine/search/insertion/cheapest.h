// The cheapest of many: the few that are kept, or the least, taken out one after another.
#pragma once

#include "problem/instance.h"

namespace tandem {

// The least of those added, by `<`: `most` of them, or fewer if so stated.
template <class Item, Int most>
class Cheapest {
public:
    explicit Cheapest(Int limit = most) : limit_(limit) {}

    void add(const Item& item) {
        if (is_full()) {
            if (!(item < items_[0])) return;
            std::pop_heap(items_.begin(), end());
            --count_;
        }
        items_[std::size_t(count_++)] = item;
        std::push_heap(items_.begin(), end());
    }

    bool is_full() const { return count_ == limit_; }

    // That which the next would have to undercut.
    const Item& dearest() const { return items_[0]; }

    // Lets the least come first; then nothing is added any more.
    void sort() { std::sort_heap(items_.begin(), end()); }

    View<const Item, 1> items() const { return {items_.data(), {count_}}; }

private:
    auto end() { return items_.begin() + count_; }

    std::array<Item, std::size_t(most)> items_;
    Int limit_;
    Int count_ = 0;
};

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
        const double least = least_of(least_.data(), blocks());
        const Int block = std::find(least_.begin(), least_.end(), least) - least_.begin();
        return std::find(&numbers_[block * length_], numbers_.end(), least) - numbers_.begin();
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
        const Int begin = block * length_;
        least_[std::size_t(block)] = least_of(&numbers_[begin], std::min(length_, count_ - begin));
    }

    // The least of some numbers, in lanes that processors compare at once.
    static double least_of(const double* numbers, Int count) {
        constexpr Int width = 4;
        std::array<double, width> lanes;
        lanes.fill(numbers[0]);
        const Int whole = count - count % width;
        for (Int index = 0; index < whole; index += width) {
            for (Int lane = 0; lane < width; ++lane) {
                double& least = lanes[std::size_t(lane)];
                least = std::min(least, numbers[index + lane]);
            }
        }
        double least = *std::min_element(lanes.begin(), lanes.end());
        for (Int index = whole; index < count; ++index) least = std::min(least, numbers[index]);
        return least;
    }

    View<double, 1> numbers_;
    Int count_, length_;
    std::array<double, most_blocks> least_;
};

}  // namespace tandem
