// Where the breaks of a route are.
#pragma once

#include <array>
#include <cstddef>

#include "rules/breaks.h"
#include "search/route/layout.h"

namespace tandem {

// Where the breaks of a route are, and when it may begin.
class PlacedBreaks {
public:
    PlacedBreaks() = default;
    PlacedBreaks(View<const Stop, 1> stops, Int begin) : begin_(begin) {
        for (Int p = 0; p < stops.size(); ++p) {
            const Rests rests(stops[p].rests);
            for (Int index = 0; index < rests.count(); ++index) {
                insert(count_, {rests.number(index), p, rests.place(index)});
            }
        }
    }

    // Which one, behind which stop, and where.
    struct One {
        Int number, stop;
        RestPlace place;

        bool is_behind(const One& other) const {
            return stop > other.stop || (stop == other.stop && place >= other.place);
        }
    };

    Int begin() const { return begin_; }
    Int count() const { return count_; }
    const One& operator[](Int index) const { return one_[static_cast<std::size_t>(index)]; }

    // These on a route that begins no sooner than then.
    PlacedBreaks from(Int begin) const {
        PlacedBreaks next = *this;
        next.begin_ = begin;
        return next;
    }

    // These with another one at an index, instead of the one there.
    PlacedBreaks with(Int index, const One& one) const {
        PlacedBreaks next = *this;
        next.one_[static_cast<std::size_t>(index)] = one;
        return next;
    }

    // These with one more at an index.
    PlacedBreaks with_more(Int index, const One& one) const {
        PlacedBreaks next = *this;
        next.insert(index, one);
        return next;
    }

    // Tell whether the one at an index lies between those beside it.
    bool is_in_order(Int index) const {
        return (index == 0 || (*this)[index].is_behind((*this)[index - 1])) &&
               (index + 1 == count_ || (*this)[index + 1].is_behind((*this)[index]));
    }

    // Write them. In place.
    void write(View<Stop, 1> stops) const {
        for (Stop& stop : stops) stop.rests = 0;
        for (Int index = 0; index < count_; ++index) {
            Stop& stop = stops[(*this)[index].stop];
            stop.rests =
                Rests(stop.rests).with((*this)[index].number, (*this)[index].place).packed();
        }
    }

private:
    void insert(Int index, const One& one) {
        for (Int next = count_; next > index; --next) {
            one_[static_cast<std::size_t>(next)] = (*this)[next - 1];
        }
        one_[static_cast<std::size_t>(index)] = one;
        ++count_;
    }

    Int begin_ = none;
    Int count_ = 0;
    std::array<One, most_breaks> one_{};
};

}  // namespace tandem
