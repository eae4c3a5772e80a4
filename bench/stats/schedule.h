// The order in which the arms of a group take their turns, so that neither place nor predecessor favours one.
#pragma once

#include <cstddef>
#include <vector>

namespace lightsweep {

/// After so many rounds the order is balanced: `arms` when even, twice that when odd; 1 for one arm.
size_t rounds_per_cycle(size_t arms);

/// The order of one round: a permutation of 0 .. arms - 1 (arms >= 1). Over rounds_per_cycle() rounds each arm stands
/// equally often in each place and follows each other arm equally often within rounds (Williams, "Experimental Designs
/// Balanced for the Estimation of Residual Effects of Treatments", Australian Journal of Scientific Research A 2,
/// 1949). Of each two rounds the second is the first turned round (ABBA for two arms), so that a linear drift cancels
/// in every such pair.
std::vector<size_t> schedule(size_t arms, size_t round);

}  // namespace lightsweep
