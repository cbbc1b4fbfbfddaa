/// A bounded set of worker threads (oneTBB). Results must not depend on how many there are: work is
/// cut into ranges, and whatever is summed across ranges is summed exactly or in a fixed order.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace transillum {

class Workers {
public:
    /// \param threads number of threads, 0 for as many as the machine has.
    /// \throws UsageError when negative or above 1024.
    explicit Workers(int threads = 0);
    ~Workers();
    Workers(Workers&&) noexcept;
    Workers& operator=(Workers&&) noexcept;

    [[nodiscard]] int count() const;

    /// Calls `body(begin, end, worker)` over [0, n) in ranges of at least `grain` items;
    /// `worker` is in [0, count()) and no two concurrent calls share it. Exceptions pass through.
    void for_ranges(std::size_t n, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t, int)>& body) const;

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace transillum
