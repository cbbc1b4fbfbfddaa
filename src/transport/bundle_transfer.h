/// Transfer along one bundle after the other, with the Monte-Carlo component beside the finite
/// elements or without.
#pragma once

#include "transport/direction_order.h"
#include "transport/finite_elements.h"
#include "transport/monte_carlo_component.h"

#include <memory>
#include <vector>

namespace transillum {

/// What automatic comes to.
[[nodiscard]] MonteCarlo representation_of(MonteCarlo monte_carlo, const PatchHierarchy& patches);

class BundleTransfer {
public:
    /// Keeps references.
    BundleTransfer(const SurfaceMesh& mesh, const PatchHierarchy& patches, double pixel_size,
                   std::uint64_t seed, const Workers& workers);

    /// The bundle that is number i of those transferred.
    [[nodiscard]] Bundle bundle(std::uint64_t i);

    /// From the next block on, what arrived along a bundle is carried on by the next. Nothing has
    /// yet. \pre not automatic
    /// \param next number of the next direction \param carried everything: the elements leave
    /// reflection to it
    void carry(MonteCarlo representation, Carried carried, const FiniteElementComponent& elements,
               std::uint64_t next);
    void carry_no_more(std::uint64_t next);
    /// Which directions come in another order. Setting it comes after carry().
    [[nodiscard]] DirectionOrder::Range shuffled() const { return order_.shuffled(); }
    void set_shuffled(const DirectionOrder::Range& range) { order_.set_shuffled(range); }
    /// From now on what elements send along a bundle is kept for residual() to tell; nobody
    /// receives anything.
    void record(MonteCarlo representation);
    /// Do those before number `next` form nets, as far as their number allows it?
    [[nodiscard]] bool is_even(std::uint64_t next) const { return order_.is_even(next); }
    /// Null unless carried.
    [[nodiscard]] const MonteCarloComponent* residual() const { return residual_.get(); }
    [[nodiscard]] MonteCarloComponent* residual() { return residual_.get(); }
    /// Directions for which it was.
    [[nodiscard]] std::uint64_t carried() const { return carried_; }
    /// Bound of what a point sends over what any patch does.
    [[nodiscard]] float headroom() const { return headroom_; }

    void transfer(Exchange& exchange, const FiniteElementComponent& elements, const Bundle& bundle);

    /// Sums of the norms of a patch, over carried() directions, whether still carried or not.
    [[nodiscard]] ResidualNorms norms(std::uint32_t patch) const;

    [[nodiscard]] double pixel_size() const { return buffer_->pixel_size(); }
    [[nodiscard]] StageSeconds seconds() const {
        StageSeconds sum = seconds_;
        return sum += buffer_->seconds();
    }

private:
    void represent(MonteCarlo representation, Carried carried);
    void make_buffer(const PatchHierarchy& cells);

    const SurfaceMesh& mesh_;
    const PatchHierarchy& patches_;
    const Workers& workers_;
    DirectionOrder order_;
    std::uint64_t seed_;
    std::unique_ptr<TransilluminationBuffer> buffer_;
    std::unique_ptr<MonteCarloComponent> residual_;
    bool records_ = false;
    std::vector<ResidualNorms> norms_;           ///< one a slot, of a component that is gone
    std::vector<BundleReflection> reflections_;  ///< one a slot
    Bundle last_;
    std::uint64_t carried_ = 0;
    float headroom_ = 1.0f;
    StageSeconds seconds_;  ///< of buffers that are gone
};

}  // namespace transillum
