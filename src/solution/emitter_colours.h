/// What emitters send, taken alone and scaled.
#pragma once

#include <transillum/scene/colours.h>
#include <transillum/solution/emitter_solution.h>

namespace transillum {

/// Those colours with every emitter dark but this one.
[[nodiscard]] Colours only(Colours colours, const Emitter& emitter);

/// Those colours with what this emitter sends multiplied.
[[nodiscard]] Colours scaled(Colours colours, const Emitter& emitter, const Spectrum& factor);

}  // namespace transillum
