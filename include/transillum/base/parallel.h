/// A bounded set of worker threads (oneTBB). Results must not depend on how many there are: work is
/// cut into ranges, and whatever is summed across ranges is summed exactly or in a fixed order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

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

/// What `add(result, i)` makes of all i in [0, n). Ranges of a fixed length each begin with a copy
/// of `nothing` and are brought together in their order by `join(result, of_range)`: rounded sums
/// do not depend on the number of threads.
template <class Result, class Add, class Join>
[[nodiscard]] Result fold(const Workers& workers, std::size_t n, const Result& nothing, Add add,
                          Join join) {
    constexpr std::size_t range = std::size_t{1} << 14;
    std::vector<Result> partial((n + range - 1) / range, nothing);
    workers.for_ranges(partial.size(), 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t r = begin; r < end; ++r)
            for (std::size_t i = r * range; i < std::min((r + 1) * range, n); ++i)
                add(partial[r], i);
    });
    Result result = nothing;
    for (const Result& p : partial) join(result, p);
    return result;
}

}  // namespace transillum
