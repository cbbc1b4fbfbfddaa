/// What a bake says of what it skips or chooses, with the reason (design 4.9).
#pragma once

#include <transillum/first_shot/light_samples.h>
#include <transillum/solution/bake.h>
#include <transillum/transport/find_dark_roots.h>

#include <vector>

namespace transillum {

void decide_first_shot(const Luminaires& luminaires, FirstShot choice, std::uint32_t patches,
                       std::vector<Decision>& decisions);
/// How many direction bins patches have.
void decide_bins(const Solution& solution, const BakeOptions& options,
                 std::vector<Decision>& decisions);
void decide_black(const Solution& solution, std::vector<Decision>& decisions);
/// \pre they are averaged
void decide_textures(const Solution& solution, std::vector<Decision>& decisions);

// A bake that goes on comes to these again.
/// \param is_lit anything shines in the iteration
void decide_light(const Solution& solution, bool is_lit, std::vector<Decision>& decisions);
/// \param asked_for pixels; 0: automatic
void decide_resolution(const Solution& solution, double pixel_size, int asked_for,
                       std::vector<Decision>& decisions);
/// In place of what an earlier transport came to.
void decide_transport(const TransportResult& transport, const DarkRoots& dark,
                      const IterationOptions& options, std::vector<Decision>& decisions);

}  // namespace transillum
