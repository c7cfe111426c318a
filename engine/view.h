// Arrays that belong to others, row by row without gaps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <type_traits>

namespace tandem {

#ifdef TANDEM_CHECKED
constexpr bool checks_indices = true;
#else
constexpr bool checks_indices = false;
#endif

// Thrown before anything is read or written outside an array.
class Outside : public std::exception {};

[[noreturn, gnu::cold, gnu::noinline]] inline void found_outside() { throw Outside(); }

// Throws at an index outside an array, in all builds.
inline void ensure_index(std::int64_t index, std::int64_t size) {
    if (std::uint64_t(index) >= std::uint64_t(size)) [[unlikely]] {
        found_outside();
    }
}

// Ends the process at an index outside an array, in builds for sanitizers.
inline void check_index(std::int64_t index, std::int64_t size) {
    if constexpr (checks_indices) {
        if (index < 0 || index >= size) std::abort();
    }
}

// A view of an array of N dimensions.
//
// Whoever writes where a number that was counted up tells does so by `at`, `first` or `part`, which
// check in all builds; all other indices are checked in builds for sanitizers alone, as that takes
// a tenth of the time of a search.
template <class T, int N>
class View {
public:
    static_assert(N >= 1);

    View() = default;
    View(T* data, const std::array<std::int64_t, N>& shape) : data_(data), shape_(shape) {}

    // A view that doesn't write of one that may.
    template <class Other>
        requires std::is_same_v<const Other, T>
    View(const View<Other, N>& from) : data_(from.data()), shape_(from.shape()) {}

    template <class... Index>
        requires(sizeof...(Index) == N)
    T& operator()(Index... index) const {
        return data_[offset(index...)];
    }

    // The row, or the element, of the first axis.
    decltype(auto) operator[](std::int64_t index) const {
        check_index(index, shape_[0]);
        if constexpr (N == 1) {
            return (data_[index]);
        } else {
            std::array<std::int64_t, N - 1> rest{};
            std::int64_t stride = 1;
            for (std::size_t axis = 1; axis < N; ++axis) {
                rest[axis - 1] = shape_[axis];
                stride *= shape_[axis];
            }
            return View<T, N - 1>(data_ + index * stride, rest);
        }
    }

    // The element, which has to be there.
    T& at(std::int64_t index) const
        requires(N == 1)
    {
        ensure_index(index, shape_[0]);
        return data_[index];
    }

    T* data() const { return data_; }
    T* begin() const
        requires(N == 1)
    {
        return data_;
    }
    T* end() const
        requires(N == 1)
    {
        return data_ + shape_[0];
    }
    const std::array<std::int64_t, N>& shape() const { return shape_; }
    std::int64_t shape(std::size_t axis) const { return shape_[axis]; }
    std::int64_t size() const { return shape_[0]; }
    bool empty() const { return shape_[0] == 0; }

    // The first `count` rows, which have to be there.
    View first(std::int64_t count) const {
        ensure_index(count, shape_[0] + 1);
        View part = *this;
        part.shape_[0] = count;
        return part;
    }

    // So many elements from one on, which have to be there.
    View part(std::int64_t from, std::int64_t count) const
        requires(N == 1)
    {
        ensure_index(from, shape_[0] + 1);
        ensure_index(count, shape_[0] - from + 1);
        return {data_ + from, {count}};
    }

private:
    template <class... Index>
    std::int64_t offset(Index... index) const {
        const std::array<std::int64_t, N> at{std::int64_t(index)...};
        std::int64_t place = 0;
        for (std::size_t axis = 0; axis < N; ++axis) {
            check_index(at[axis], shape_[axis]);
            place = place * shape_[axis] + at[axis];
        }
        return place;
    }

    T* data_ = nullptr;
    std::array<std::int64_t, N> shape_{};
};

// Copy the first elements of a row to another, both of which have to hold so many. In place.
template <class T, class Other>
void copy_first(View<T, 1> from, std::int64_t count, View<Other, 1> to) {
    std::copy_n(from.first(count).begin(), count, to.first(count).begin());
}

}  // namespace tandem
