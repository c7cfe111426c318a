// Rows that the engine owns, of zeros until something is written.
#pragma once

#include <memory>

#include "view.h"

namespace tandem {

// Whether most of some rows are written, or hardly any: of these, each small page takes memory once
// something is written there, and there may be more than there is memory.
enum class Filling { dense, sparse };

// OwnMemory of zeros, which begins where a line of the processor's cache does.
class OwnMemory {
public:
    OwnMemory(std::size_t bytes, Filling filling);

    void* begin() const { return begin_; }

private:
    struct Release {
        std::size_t mapped;  // bytes of the system's, or none

        void operator()(void* memory) const;
    };

    std::unique_ptr<void, Release> room_;
    void* begin_;
};

// A view of rows, and where they are.
template <class T, int N>
class OwnRows : public View<T, N> {
public:
    explicit OwnRows(const std::array<std::int64_t, N>& shape, Filling filling = Filling::dense)
        : OwnRows(shape, OwnMemory(bytes_of(shape), filling)) {}

private:
    static_assert(std::is_trivially_copyable_v<T>);

    static std::size_t bytes_of(const std::array<std::int64_t, N>& shape) {
        std::size_t bytes = sizeof(T);
        for (const std::int64_t axis : shape) bytes *= std::size_t(axis);
        return bytes;
    }

    OwnRows(const std::array<std::int64_t, N>& shape, OwnMemory memory)
        : View<T, N>(static_cast<T*>(memory.begin()), shape), memory_(std::move(memory)) {}

    OwnMemory memory_;
};

// A row of what is written before it is read.
template <class T>
class Row {
public:
    explicit Row(std::int64_t size)
        : room_(std::make_unique_for_overwrite<T[]>(std::size_t(size))),
          view_(room_.get(), {size}) {}

    View<T, 1> view() const { return view_; }
    operator View<T, 1>() const { return view_; }
    std::int64_t size() const { return view_.size(); }
    operator View<const T, 1>() const { return view_; }
    T& operator[](std::int64_t index) const { return view_[index]; }
    T& at(std::int64_t index) const { return view_.at(index); }

private:
    std::unique_ptr<T[]> room_;
    View<T, 1> view_;
};

}  // namespace tandem
