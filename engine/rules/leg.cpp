// Legs computed from where nodes are, the same to the last bit as in `model/problem/distances`: the
// same operations in the same order, none of them fused.
#include "rules/leg.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace tandem {
namespace {

// How distances are rounded in the unit of coordinates; on the globe they are angles.
enum class Rounding : Int { globe = -1, exact, round, trunc, dimacs, thousandths };

constexpr double float_noise_ms = 5e-7;  // less above a whole millisecond is that millisecond
constexpr double coarse_ms = 0x1p31;  // from here on, doubles are no finer than half of the noise
constexpr double mm_per_m = 1000.0;

// Squared halves of chords: up to where few terms tell the arc, and up to where it is told from the
// chord to one end, not to the other's antipode.
constexpr double short_arc = 1.0 / 64.0;
constexpr double long_arc = 0.5;

// Coefficients of arcsin(s) / s in powers of s squared, the highest first: the k-th from the end is
// (2k)! / (k!)^2 / (4^k (2k + 1)), rounded once.
constexpr std::size_t short_terms = 8, long_terms = 44;
constexpr std::array<double, long_terms> arcsine_series = {
    0.0009860731369833312, 0.0010211486797106276,
    0.0010583541258722428, 0.0010978750465914472,
    0.0011399183307022236, 0.0011847152561624392,
    0.001232525098500017,  0.0012836393876290285,
    0.0013383869512751784, 0.0013971399176302534,
    0.0014603208940791154, 0.0015284115961225677,
    0.001601963275351444,  0.0016816093935831068,
    0.0017680811205154183, 0.0018622264064031275,
    0.0019650336162772837, 0.0020776610325181676,
    0.0022014739737101384, 0.002338091892111975,
    0.0024894486782468836, 0.00265787063820729,
    0.002846178401108942,  0.0030578216492580306,
    0.003297059503473485,  0.0035692053938259347,
    0.003880964558837669,  0.004240907093679363,
    0.004660143486915096,  0.005153309682319905,
    0.005740037670841924,  0.006447210311889649,
    0.0073125258735988454, 0.008390335809616815,
    0.009761609529194078,  0.011551800896139705,
    0.01396484375,         0.017352764423076924,
    0.022372159090909092,  0.030381944444444444,
    0.044642857142857144,  0.075,
    0.16666666666666666,   1.0,
};

// arcsin(s) / s by the square of s, of so many terms. Without a loop, so that the processor begins
// with the next leg before it is done with this.
template <std::size_t... term>
double series(double square, std::index_sequence<term...>) {
    constexpr std::size_t first = long_terms - sizeof...(term);
    double value = 0.0;
    ((value = value * square + arcsine_series[first + term]), ...);
    return value;
}

// The arc over a chord, by the square of its half, up to `long_arc` but for rounding.
double arc_over(double quarter) {
    const double chord = 2.0 * std::sqrt(quarter);
    if (quarter <= short_arc)
        return chord * series(quarter, std::make_index_sequence<short_terms>());
    return chord * series(std::min(quarter, long_arc), std::make_index_sequence<long_terms>());
}

// The angle between two unit vectors.
double angle_between(const Point& origin, const Point& to) {
    double x = origin.x - to.x, y = origin.y - to.y, z = origin.z - to.z;
    double quarter = (x * x + y * y + z * z) * 0.25;
    if (quarter <= long_arc) return arc_over(quarter);
    x = origin.x + to.x, y = origin.y + to.y, z = origin.z + to.z;
    quarter = (x * x + y * y + z * z) * 0.25;
    return std::numbers::pi - arc_over(quarter);
}

// The distance between two nodes in the plane, in the unit of coordinates.
double units_between(const Point& origin, const Point& to, Rounding rounding) {
    const double east = origin.x - to.x, north = origin.y - to.y;
    // Never by `hypot`, which rounds otherwise.
    const double straight = std::sqrt(east * east + north * north);
    switch (rounding) {
        case Rounding::round:
            return std::floor(straight + 0.5);
        case Rounding::trunc:
            return std::trunc(straight);
        case Rounding::dimacs:
            return std::trunc(straight * 10.0) / 10.0;
        case Rounding::thousandths:
            return std::floor(straight * 1000.0 + 0.5) / 1000.0;
        default:
            return straight;
    }
}

// Metres between two nodes, not a number if one is nowhere.
double metres_between(const Point& origin, const Point& to, const LegLaw& law) {
    const auto rounding = static_cast<Rounding>(law.rounding);
    const double units = rounding == Rounding::globe ? angle_between(origin, to)
                                                     : units_between(origin, to, rounding);
    return units * law.metres;
}

// A duration in whole milliseconds, rounded up.
Int ceiled_ms(double duration) {
    double noise = float_noise_ms;
    if (duration >= coarse_ms) {
        noise = std::max(noise, 2.0 * (std::nextafter(duration, HUGE_VAL) - duration));
    }
    return Int(std::ceil(duration - noise));
}

// A distance in whole millimetres.
Int rounded_mm(double metres) { return Int(std::nearbyint(metres * mm_per_m)); }

}  // namespace

Leg straight_leg(const Point& origin, const Point& to, const LegLaw& law) {
    if (origin.node == to.node) return {0, 0};
    const bool sets_up = law.sets_up != 0 && origin.site != to.site;
    const Int setup = sets_up ? to.setup_duration : 0;
    const double metres = metres_between(origin, to, law);
    if (std::isnan(metres)) return {law.nowhere + setup, law.nowhere};
    return {ceiled_ms(metres * law.pace) + law.more + setup, rounded_mm(metres)};
}

Int straight_distance(const Point& origin, const Point& to, const LegLaw& law) {
    if (origin.node == to.node) return 0;
    const double metres = metres_between(origin, to, law);
    return std::isnan(metres) ? law.nowhere : rounded_mm(metres);
}

}  // namespace tandem
