#include <doctest/doctest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "randomness.h"
#include "search/moves/operations.h"
#include "search/moves/split.h"

namespace tandem {
namespace {

constexpr Int nodes = 40;
constexpr auto num_nodes = std::size_t(nodes);

// A truck with a drone twice as fast, and customers at places on a grid; time alone costs. A fifth
// of them can't be flown to.
struct Day {
    std::vector<std::int32_t> legs = std::vector<std::int32_t>(2 * num_nodes * num_nodes * 2);
    std::array<Node, num_nodes> node{};
    std::array<VehicleType, 1> type{};
    std::array<Rate, 1> rate{};
    std::array<bool, 2 * num_nodes> can{};

    explicit Day(View<std::uint64_t, 1> rng) {
        std::array<std::array<Int, 2>, num_nodes> at;
        for (auto& [x, y] : at) {
            x = below(rng, 100);
            y = below(rng, 100);
        }
        for (std::size_t travel = 0; travel < 2; ++travel) {
            for (std::size_t from = 0; from < num_nodes; ++from) {
                for (std::size_t to = 0; to < num_nodes; ++to) {
                    const Int far_off =
                        std::abs(at[from][0] - at[to][0]) + std::abs(at[from][1] - at[to][1]);
                    const std::size_t entry = 2 * ((travel * num_nodes + from) * num_nodes + to);
                    legs[entry] = std::int32_t(travel == 0 ? 2 * far_off : far_off);
                    legs[entry + 1] = std::int32_t(far_off);
                }
            }
        }
        for (Node& each : node) each = {0, far, 3, 0, far, {1}};
        for (std::size_t each = 0; each < num_nodes; ++each) {
            can[each] = true;
            can[num_nodes + each] = below(rng, 5) > 0;
        }
        type[0].drones = 1;
        type[0].drone_travel = type[0].home_travel = 1;
        type[0].endurance = 60;
        type[0].launch_duration = type[0].relaunch_duration = 1;
        type[0].recovery_duration = 1;
        rate[0].time = 1.0;
    }

    ProblemData data() {
        tandem_problem_data raw{};
        raw.problem.num_depots = 1;
        raw.problem.num_nodes = nodes;
        raw.problem.num_types = 1;
        raw.strategy.loops = raw.strategy.crossings = true;
        raw.problem.node = {node.data(), {1, nodes, 1}};
        raw.problem.type = {type.data(), {1}};
        raw.problem.rate = {rate.data(), {1}};
        raw.can = {can.data(), {1, 2, nodes}};
        raw.leg.stated = raw.back.stated = {legs.data(), {2, nodes, nodes, 2}};
        return data_of(raw);
    }
};

TEST_CASE("a changed order costs what it does if all of it is cut anew") {
    std::array<std::uint64_t, 1> state{3};
    const View<std::uint64_t, 1> rng{state.data(), {1}};
    Day day(rng);
    const ProblemData data = day.data();
    SplitScratch scratch(nodes + 1);
    SplitScratch changed(nodes + 1);
    SplitScratch fresh(nodes + 1);
    Int cheaper = 0;
    Int given_up = 0;
    for (Int trial = 0; trial < 300; ++trial) {
        std::vector<Line> room(num_nodes + 1);
        const View<Line, 1> line{room.data(), {nodes + 1}};
        for (Int place = 0; place < nodes; ++place) line[place].node = place;
        line[nodes].node = 0;
        for (Int place = nodes - 1; place > 1; --place) {
            std::swap(line[place].node, line[1 + below(rng, place)].node);
        }
        measure(data, 0, line, line.size());
        const double before = split(data, 0, line, line.size(), scratch);
        const Int one = 1 + below(rng, nodes - 2);
        const Int other = std::min(nodes - 1, one + 1 + below(rng, 6));
        shift(line, one, other);
        measure(data, 0, line, line.size());
        std::vector<Line> again = room;
        const double after = split(data, 0, {again.data(), {nodes + 1}}, line.size(), fresh);
        const double most = double(below(rng, 20));
        const double found =
            split_changed(data, 0, line, line.size(), {{one, other}, scratch, most}, changed);
        if (found == infinite_cost) {
            CHECK(after >= before + most);
            ++given_up;
            continue;
        }
        CHECK(found == doctest::Approx(after));
        CHECK(present_cost(data, 0, line, line.size()) == doctest::Approx(after));
        cheaper += after < before;
    }
    CHECK(cheaper > 10);
    CHECK(given_up > 10);
}

TEST_CASE("an order with a place more or less costs what it does if all of it is cut anew") {
    std::array<std::uint64_t, 1> state{5};
    const View<std::uint64_t, 1> rng{state.data(), {1}};
    Day day(rng);
    const ProblemData data = day.data();
    SplitScratch scratch(nodes + 1);
    SplitScratch changed(nodes + 1);
    SplitScratch fresh(nodes + 1);
    Int given_up = 0;
    for (Int trial = 0; trial < 300; ++trial) {
        const Int more = trial % 2 == 0 ? 1 : -1;
        const Int one = 1 + below(rng, nodes - 3);
        // Customers in order, without that at place `one`, or all of them.
        const auto write = [&](std::vector<Line>& room, bool lacks_one) {
            room.resize(num_nodes + 1);
            Int place = 0;
            for (Int node = 0; node < nodes; ++node) {
                if (node != one || !lacks_one) room[std::size_t(place++)].node = node;
            }
            room[std::size_t(place++)].node = 0;
            const View<Line, 1> line{room.data(), {place}};
            measure(data, 0, line, place);
            return line;
        };
        std::vector<Line> before, now, again;
        const View<Line, 1> former = write(before, more > 0);
        const double cost = split(data, 0, former, former.size(), scratch);
        const View<Line, 1> line = write(now, more < 0);
        const double after = split(data, 0, write(again, more < 0), line.size(), fresh);
        const double most = double(below(rng, 20));
        const double found =
            split_changed(data, 0, line, line.size(), {{one, one, more}, scratch, most}, changed);
        if (found == infinite_cost) {
            CHECK(after >= cost + most);
            ++given_up;
            continue;
        }
        CHECK(found == doctest::Approx(after));
    }
    CHECK(given_up > 10);
    CHECK(given_up < 290);
}

}  // namespace
}  // namespace tandem
