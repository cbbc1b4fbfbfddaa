#include <transillum/base/error.h>
#include <transillum/base/parallel.h>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <string>
#include <thread>

namespace transillum {

struct Workers::Arena {
    explicit Arena(int threads)
        : allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)),
          arena(threads),
          count(threads) {}
    // Without it oneTBB starts no more threads than the machine has cores.
    tbb::global_control allowed;
    tbb::task_arena arena;
    int count;
};

Workers::Workers(int threads) {
    if (threads < 0 || threads > 1024)
        throw UsageError("threads: " + std::to_string(threads) +
                         "; accepted: 0 (as many as the machine has) to 1024");
    if (threads == 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    arena_ = std::make_unique<Arena>(threads);
}

Workers::~Workers() = default;
Workers::Workers(Workers&&) noexcept = default;
Workers& Workers::operator=(Workers&&) noexcept = default;

int Workers::count() const {
    return arena_->count;
}

void Workers::for_ranges(std::size_t n, std::size_t grain,
                         const std::function<void(std::size_t, std::size_t, int)>& body) const {
    if (n == 0) return;
    arena_->arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, n, std::max<std::size_t>(grain, 1)),
            [&](const tbb::blocked_range<std::size_t>& r) {
                body(r.begin(), r.end(), tbb::this_task_arena::current_thread_index());
            },
            tbb::simple_partitioner());
    });
}

}  // namespace transillum
