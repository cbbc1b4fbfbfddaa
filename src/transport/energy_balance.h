/// Energy balance of the clusters (aggregation-disaggregation, design 4.4).
///
/// The average of eq. (5) forgets its start only as m^-(1-a), a the albedo. But the transfers made
/// so far also say which share of cluster j's flux reaches cluster i. Solving
///     F_i = S_i + rho_i sum_j K_ij F_j
/// gives the fluxes that the iteration is heading for, and the estimate is scaled to them.
#pragma once

#include "transport/clusters.h"
#include "transport/exchange.h"
#include "transport/finite_elements.h"

namespace transillum {

enum class BalanceShape {
    flat,  ///< a cluster's patches all take its mean incoming radiance; transfers count fragments,
           ///< whatever they carried
    kept   ///< patches keep their shares; transfers are weighted with the radiance that was carried
};

/// No radiance that arrives exceeds the largest source over 1 - albedo; of lobes, whose albedo
/// depends on the angle, nothing is said: infinite. \param brightest_environment bound of its
/// radiance
[[nodiscard]] SpectrumSum largest_incoming(const FiniteElementComponent& component,
                                           float brightest_environment, const Workers& workers);

/// Scales the incoming radiance of every patch to the balance of its cluster. Everything is
/// measured in fragments, as the transfers are: a uniform radiance in a closed scene then is in
/// balance to the last digit, for any clusters. No patch is raised above what any may receive.
/// \param transfer collected since the component's last restart. \param brightest_environment
/// bound of its radiance. \throws UsageError when nothing absorbs and nothing leaves the scene.
void balance_energy(FiniteElementComponent& component, const Clusters& clusters,
                    const ClusterTransfer& transfer, BalanceShape shape,
                    float brightest_environment, const Workers& workers);

}  // namespace transillum
