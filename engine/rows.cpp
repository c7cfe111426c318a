#include "rows.h"

#include <sys/mman.h>

#include <new>

namespace tandem {
namespace {

constexpr std::size_t cache_line = 64;

// From how many bytes on the system is asked for pages of their own.
constexpr std::size_t large = std::size_t{1} << 22;

// Huge pages are quicker to come by where most of them is used.
void advise(void* memory, std::size_t bytes, Filling filling) {
#ifdef MADV_HUGEPAGE
    // A kernel that knows of no huge pages has none to spare or to spend.
    madvise(memory, bytes, filling == Filling::dense ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
#else
    static_cast<void>(memory), static_cast<void>(bytes), static_cast<void>(filling);
#endif
}

void* mapped(std::size_t bytes, Filling filling) {
    int flags = MAP_PRIVATE | MAP_ANONYMOUS;
    if (filling == Filling::sparse) flags |= MAP_NORESERVE;
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, flags, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    advise(memory, bytes, filling);
    return memory;
}

void* zeros(std::size_t bytes) {
    void* memory = std::calloc(bytes + cache_line, 1);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

}  // namespace

void OwnMemory::Release::operator()(void* memory) const {
    if (mapped > 0) {
        munmap(memory, mapped);
    } else {
        std::free(memory);
    }
}

OwnMemory::OwnMemory(std::size_t bytes, Filling filling)
    : room_(bytes < large ? zeros(bytes) : mapped(bytes, filling),
            Release{bytes < large ? 0 : bytes}),
      begin_(room_.get()) {
    std::size_t room = bytes + cache_line;
    if (bytes < large) std::align(cache_line, bytes, begin_, room);
}

}  // namespace tandem
