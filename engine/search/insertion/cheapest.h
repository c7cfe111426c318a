// The few cheapest of many.
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

}  // namespace tandem
