#include "bench/stats/schedule.h"

#include "renderer/base/check.h"

#include <algorithm>

namespace lightsweep {

size_t rounds_per_cycle(size_t arms) {
    CHECK(arms > 0);
    return arms == 1 ? 1 : arms % 2 == 0 ? arms : 2 * arms;
}

std::vector<size_t> schedule(size_t arms, size_t round) {
    const size_t pair = round % rounds_per_cycle(arms) / 2;
    std::vector<size_t> order(arms);
    // Williams' row 0, 1, n - 1, 2, n - 2, ... moved on by one arm per pair of rounds. For an even number of arms the
    // turned rows are the other half of the square; for an odd number they are its second square.
    for (size_t place = 0; place < arms; ++place) {
        const size_t step = place % 2 == 1 ? (place + 1) / 2 : arms - place / 2;
        order[place] = (step + pair) % arms;
    }
    if (round % 2 == 1) std::ranges::reverse(order);
    return order;
}

}  // namespace lightsweep
