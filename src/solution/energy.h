/// Where the light of a solution goes.
#pragma once

#include <transillum/base/monitor.h>
#include <transillum/solution/solution.h>
#include <transillum/transport/iterate.h>

namespace transillum {

/// Share of uniform light that a patch reflects, by both lobes.
[[nodiscard]] Spectrum reflected_share(const Solution& solution, std::uint32_t patch);

/// Of the first shot's light before any reflection; what surfaces absorb of it is not told apart.
[[nodiscard]] EnergyBalance measure_first_shot(const Solution& solution);

/// \pre the solution has its irradiances and glossy elements.
[[nodiscard]] EnergyBalance measure_balance(const Solution& solution,
                                            const EnergyBalance& first_shot,
                                            const TransportResult& transport);

/// Light that meets lobes sharper than the bins can hold is blurred on its way to other surfaces:
/// pictures of mirrors are none the worse, caustics are.
void warn_of_sharp_lobes(const Solution& solution, Monitor& monitor);

}  // namespace transillum
