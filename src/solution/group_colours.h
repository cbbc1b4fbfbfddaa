/// The colours of a solution, taken out and put in.
#pragma once

#include <transillum/scene/colours.h>
#include <transillum/solution/solution.h>

namespace transillum {

[[nodiscard]] Colours colours_of(const Solution& solution);

/// With all that follows from them but light: means over leaves, reflection of the glossy sides
/// (which sides are glossy, and their bins, stay as they are), what light samples send.
/// \pre as many materials and lights as before.
void put_colours(Solution& solution, Colours colours);

}  // namespace transillum
