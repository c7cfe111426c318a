#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "randomness.h"
#include "search/moves/operation_row.h"

namespace tandem {
namespace {

constexpr Int stops = 12, customers = 2 * stops;
constexpr Int room = customers + 3;

// A trip of a truck from depot to depot, and who isn't on it.
class Day {
public:
    Day() {
        row_.append({0, nobody, true});
        for (Int node = 1; node <= stops; ++node) {
            row_.append({std::int32_t(node), nobody, true});
        }
        row_.append({0, nobody, true});
        for (Int node = stops + 1; node <= customers; ++node) left_out_.push_back(node);
    }

    // Change something at random; false if that can't be.
    bool change(View<std::uint64_t, 1> rng) {
        const bool first = uniform(rng) < 0.5;
        const Int place = 1 + below(rng, row_.length() - 2);
        const Int begin = row_.begin_of(place), end = row_.end_behind(begin);
        switch (below(rng, 7)) {
            case 0: {
                const auto node = row_[place].node;
                if (row_.length() <= 4 || !row_.remove_stop(place, first)) return false;
                left_out_.push_back(node);
                return true;
            }
            case 1: {
                const auto flown = row_[begin].flown;
                row_.remove_flight(begin);
                if (flown != nobody) left_out_.push_back(flown);
                return flown != nobody;
            }
            case 2: {
                if (left_out_.empty()) return false;
                row_.insert_stop(place, left_out_.back());
                left_out_.pop_back();
                return true;
            }
            case 3: {
                const Int recovery = std::min(place + 1 + below(rng, 3), row_.length() - 1);
                if (left_out_.empty() || !row_.insert_flight(place, recovery, left_out_.back())) {
                    return false;
                }
                left_out_.pop_back();
                return true;
            }
            case 4:
                if (end == begin + 1) return false;
                row_.part(begin + 1 + below(rng, end - begin - 1), first);
                return true;
            case 5:
                return row_[place].joint && row_.move_joint(place, first);
            default:
                row_.reverse(place, place + below(rng, row_.length() - 1 - place));
                return true;
        }
    }

    // Check that everybody is served once or left out, and that all stops are of operations.
    void check() const {
        std::vector<Int> seen(left_out_.begin(), left_out_.end());
        REQUIRE(row_[0].joint);
        REQUIRE(row_[row_.length() - 1].joint);
        REQUIRE(row_[row_.length() - 1].flown == nobody);
        for (Int place = 0; place < row_.length(); ++place) {
            const OperationStop& stop = row_[place];
            if (stop.node > 0) seen.push_back(stop.node);
            if (stop.flown != nobody) seen.push_back(stop.flown);
            if (stop.joint) continue;
            REQUIRE(stop.flown == nobody);
            REQUIRE(row_[row_.begin_of(place)].flown != nobody);
        }
        std::sort(seen.begin(), seen.end());
        REQUIRE(Int(seen.size()) == customers);
        for (Int node = 1; node <= customers; ++node) {
            REQUIRE(seen[std::size_t(node - 1)] == node);
        }
    }

    OperationRow& row() { return row_; }

private:
    std::array<OperationStop, room> place_{};
    OperationRow row_{{place_.data(), {room}}, 0};
    std::vector<Int> left_out_;
};

TEST_CASE("changes of operations lose nobody and leave operations") {
    std::uint64_t state = 1;
    const View<std::uint64_t, 1> rng{&state, {1}};
    Int changes = 0;
    for (Int trial = 0; trial < 200; ++trial) {
        Day day;
        for (Int turn = 0; turn < 300; ++turn) {
            changes += day.change(rng) ? 1 : 0;
            day.check();
        }
    }
    CHECK(changes > 20'000);
}

TEST_CASE("an operation is flown the other way round where its stops are reversed") {
    Day day;
    OperationRow& row = day.row();
    REQUIRE(row.insert_flight(2, 5, 20));
    row.reverse(1, 6);
    CHECK(row[1].node == 6);
    CHECK(row[2].node == 5);
    CHECK(row[2].flown == 20);
    CHECK_FALSE(row[3].joint);
    CHECK_FALSE(row[4].joint);
    CHECK(row[5].node == 2);
    CHECK(row[5].joint);
    CHECK(row[5].flown == nobody);
}

TEST_CASE("truck and drone meet later where both go on together") {
    Day day;
    OperationRow& row = day.row();
    REQUIRE(row.insert_flight(2, 4, 20));
    REQUIRE(row.move_joint(4, false));
    CHECK(row.end_behind(2) == 5);
    REQUIRE(row.move_joint(2, true));
    CHECK(row[1].flown == 20);
    CHECK(row.end_behind(1) == 5);
}

TEST_CASE("operations are put in place of others between stops that stay") {
    Day day;
    OperationRow& row = day.row();
    std::array<OperationStop, room> place{};
    OperationRow draft{{place.data(), {room}}, 0};
    draft.copy(row, 3, 6);
    REQUIRE(draft.remove_stop(1, true));
    REQUIRE(draft.insert_flight(0, 2, 4));
    row.insert_flight(6, 8, 20);
    row.replace(3, 6, draft);
    CHECK(row.length() == stops + 1);
    CHECK(row[3].flown == 4);
    CHECK(row.end_behind(3) == 5);
    CHECK(row[5].flown == 20);
}

}  // namespace
}  // namespace tandem
