// Arithmetic on several numbers at once, the same to the last bit on every processor.
//
// Each lane is computed alone.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

// Before a function whose loops are compiled for several families of processors, the best of which
// is taken as the library is loaded. Results are the same: nothing is fused.
#ifdef TANDEM_CLONES
#define TANDEM_FOR_PROCESSORS [[gnu::flatten, gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define TANDEM_FOR_PROCESSORS
#endif

namespace tandem {

#if defined(__AVX512F__)
constexpr int register_bytes = 64;
#elif defined(__AVX__)
constexpr int register_bytes = 32;
#else
constexpr int register_bytes = 16;
#endif

// So many bytes of numbers in one register, and whole numbers as large.
template <class Number, int bytes>
struct Register {
    using Integer = std::conditional_t<sizeof(Number) == 4, std::int32_t, std::int64_t>;
    typedef Number Type __attribute__((vector_size(bytes)));
    typedef Integer Integers __attribute__((vector_size(bytes)));
};

// So many numbers, register by register.
template <class Number, int length>
struct Vector {
    static constexpr int bytes = length * int{sizeof(Number)};
    static constexpr int piece_bytes = bytes < register_bytes ? bytes : register_bytes;
    static constexpr int num_pieces = bytes / piece_bytes;
    using Piece = Register<Number, piece_bytes>::Type;
    Piece piece[num_pieces];

    // What a function makes of each register, and of those of others.
    template <class Function, class... Other>
    static Vector each(Function make, const Other&... other) {
        Vector made;
        for (int k = 0; k < num_pieces; ++k) made.piece[k] = make(other.piece[k]...);
        return made;
    }

    // The same number in all. Less nothing, it is itself, even if it is a negative zero.
    static Vector all(Number value) {
        return each([value] { return value - Piece{}; });
    }

    friend Vector operator+(const Vector& a, const Vector& b) {
        return each([](const Piece& x, const Piece& y) { return x + y; }, a, b);
    }
    friend Vector operator-(const Vector& a, const Vector& b) {
        return each([](const Piece& x, const Piece& y) { return x - y; }, a, b);
    }
    friend Vector operator*(const Vector& a, const Vector& b) {
        return each([](const Piece& x, const Piece& y) { return x * y; }, a, b);
    }
    friend Vector operator/(const Vector& a, const Vector& b) {
        return each([](const Piece& x, const Piece& y) { return x / y; }, a, b);
    }
    friend Vector operator+(const Vector& a, Number b) { return a + all(b); }
    friend Vector operator-(Number a, const Vector& b) { return all(a) - b; }
    friend Vector operator*(Number a, const Vector& b) { return all(a) * b; }
    friend Vector operator*(const Vector& a, Number b) { return a * all(b); }
    Vector& operator+=(const Vector& other) { return *this = *this + other; }
};

// The larger of each two, the second where they are equal.
template <class Number, int length>
Vector<Number, length> larger(const Vector<Number, length>& a, const Vector<Number, length>& b) {
    return Vector<Number, length>::each([](const auto& x, const auto& y) { return x > y ? x : y; },
                                        a, b);
}

// The numbers where others are at most so much, and one instead elsewhere.
template <class Number, int length>
Vector<Number, length> where_at_most(const Vector<Number, length>& others, Number most,
                                     const Vector<Number, length>& numbers, Number instead) {
    using Piece = Vector<Number, length>::Piece;
    return Vector<Number, length>::each(
        [most, instead](const Piece& x, const Piece& y) {
            return x <= Piece{} + most ? y : Piece{} + instead;
        },
        others, numbers);
}

// The least of the numbers.
template <class Number, int length>
Number least_of(const Vector<Number, length>& numbers) {
    if constexpr (length == 1) {
        return numbers.piece[0][0];
    } else if constexpr (length * int{sizeof(Number)} <= 16) {
        Number least = numbers.piece[0][0];
        for (int lane = 1; lane < length; ++lane) {
            if (numbers.piece[0][lane] < least) least = numbers.piece[0][lane];
        }
        return least;
    } else {
        Vector<Number, length / 2> half[2];
        std::memcpy(half, &numbers, sizeof half);
        using Piece = Vector<Number, length / 2>::Piece;
        return least_of(Vector<Number, length / 2>::each(
            [](const Piece& x, const Piece& y) { return x < y ? x : y; }, half[0], half[1]));
    }
}

// Read numbers that lie in a row.
template <class Numbers>
void load(const auto* from, Numbers& numbers) {
    std::memcpy(&numbers, from, sizeof numbers);
}

// Write numbers to where they lie in a row.
template <class Numbers>
void store(const Numbers& numbers, auto* to) {
    std::memcpy(to, &numbers, sizeof numbers);
}

}  // namespace tandem
