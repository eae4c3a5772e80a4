// What statistics take for granted of records that were read from a file.
#pragma once

#include "bench/report/record.h"

#include <string>

namespace lightsweep {

/// Throws InputError, with `where` and the JSON pointer, unless all lists of a cell's samples are equally long.
void require_sound(const CellResult& cell, const std::string& where);
/// The same of all cells, and of the noise twin.
void require_sound(const GroupResult& group, const std::string& where);

}  // namespace lightsweep
