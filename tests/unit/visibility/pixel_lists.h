/// What a buffer's lists hold, for tests.
#pragma once

#include <transillum/visibility/transillumination_buffer.h>

#include <functional>
#include <mutex>

namespace transillum::testing_support {

using PixelList = std::span<const Fragment>;

/// Calls for every pixel list that holds something, one at a time.
inline void for_lists(TransilluminationBuffer& buffer, const Bundle& bundle, const Workers& workers,
                      const std::function<void(PixelList)>& visit) {
    std::mutex one_at_a_time;
    buffer.trace(bundle, workers, [&](const TileLists& tile, int) {
        const std::lock_guard lock(one_at_a_time);
        for (int i = 0; i < tile.width * tile.height; ++i)
            if (tile.first[i] < tile.first[i + 1])
                visit(tile.fragments.subspan(tile.first[i], tile.first[i + 1] - tile.first[i]));
    });
}

}  // namespace transillum::testing_support
