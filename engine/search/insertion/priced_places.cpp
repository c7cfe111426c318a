// All places of a customer, or a shipment, on a route.

#include "search/insertion/places.h"
#include "search/search.h"

using namespace tandem;

extern "C" int tandem_write_places(const tandem_problem_data* data, tandem_search* search,
                                   int64_t node, int64_t slot, const tandem_f64_1d* costs,
                                   const tandem_i64_3d* placements, int64_t* count) {
    return guarded([&] {
        const ProblemData problem = data_of(*data);
        problem.deadline.go_on();
        const View<double, 1> cost(*costs);
        const View<Int, 3> placed(*placements);
        PricedPlaces places;
        // Whatever is found is overlooked, so that all there is comes to be priced.
        Best best{1.0, search->rng};
        best.listed = &places;
        find_at_home({problem, looking(problem, *search), node, false, best}, slot);
        *count = 0;
        places.for_each([&](const PricedPlaces::Priced& found) {
            if (*count == std::min(cost.size(), placed.shape(0))) return;
            cost[*count] = found.cost;
            const View<Int, 2> rows = placed[(*count)++];
            for (Int row = 0; row < rows.shape(0); ++row) {
                const bool is_there = row < found.move.count;
                const Placement& each = found.move.placement[std::size_t(is_there ? row : 0)];
                rows(row, 0) = is_there ? each.node : nowhere;
                rows(row, 1) = Int(each.how);
                rows(row, 2) = each.from;
                rows(row, 3) = each.to;
                rows(row, 4) = each.drone;
            }
        });
    });
}
