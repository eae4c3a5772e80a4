// What the shell sees of the project's programs.
#pragma once

namespace lightsweep {

enum ExitCode : int {
    kDone = 0,
    kVerdictFailed = 1,  ///< compare --fail-on; a stress case that fails
    kBadInput = 2,       ///< bad usage or bad input
    kRefused = 3,        ///< no context, wrong renderer, no trustworthy timer
    kCellsFailed = 4,    ///< some cells failed; the rest was measured
    kInterrupted = 5,    ///< run again with --resume
};

}  // namespace lightsweep
