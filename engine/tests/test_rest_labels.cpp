// Which ways to have come somewhere are kept where only few are.
#include <doctest/doctest.h>

#include <algorithm>

#include "search/route/rests.h"

namespace tandem {
namespace {

// A driver who is later, having driven less since the last rest.
RestLabel come_at(Int time, Int driven) {
    RestLabel label{};
    label.time = time;
    label.driver.driven = driven;
    return label;
}

bool has(const RestLabels& labels, Int time) {
    return std::any_of(labels.begin(), labels.end(),
                       [&](const RestLabel& label) { return label.time == time; });
}

}  // namespace

TEST_CASE("where as many ways are kept as may be, the last goes for one that is sooner") {
    RestLabels labels(2, none);
    CHECK(labels.add(come_at(-30, 3)));
    CHECK(labels.add(come_at(-10, 1)));
    CHECK(labels.add(come_at(-20, 2)));
    CHECK(labels.end() - labels.begin() == 2);
    CHECK(has(labels, -30));
    CHECK(has(labels, -20));
    CHECK_FALSE(labels.add(come_at(-5, 0)));
}

}  // namespace tandem
