/// A solution that knows what of its light comes from which emitter, so that emitters can be dimmed
/// or tinted without another bake: light adds up.
#pragma once

#include <transillum/solution/solution.h>

#include <cstdint>
#include <string>
#include <vector>

namespace transillum {

/// A material that some surface emits by, a light without extent, or the environment.
struct Emitter {
    enum class Kind : std::uint8_t { material, light, environment };
    std::string name;  ///< of that; of several alike, with #2, #3, ... behind it
    Kind kind = Kind::material;
    std::uint32_t index = 0;  ///< of the material or light
};

/// What the iteration made of one emitter's light; members named as those of Solution mean the
/// same.
struct EmitterPart {
    Emitter emitter;
    std::vector<Spectrum> indirect_irradiance, standard_error, glossy_elements;
    double relative_error = 0.0;
    EnergyBalance balance;
};

struct EmitterSolution {
    Solution all;  ///< a whole solution: the sum of the parts
    std::vector<EmitterPart> parts;
};

/// Those of a solution that has its surface and lighting; darkened ones are left out.
[[nodiscard]] std::vector<Emitter> emitters_of(const Solution& solution);

/// Makes `all` the sum of the parts: all but what emitters send. Standard errors are added up, as
/// the same directions made them.
void add_up(EmitterSolution& solution);

/// Multiplies, channel by channel, what an emitter sends and all that comes of it.
/// \throws UsageError for a name that no part has, or a factor that is negative or not finite.
void scale_emitter(EmitterSolution& solution, const std::string& name, const Spectrum& factor);

}  // namespace transillum
