/// The picture of who stands still: the stochastic iteration goes on over the solution's elements
/// (paper §5) in a thread of its own, and every pass of it sharpens the picture. What is carried of
/// the Monte-Carlo component stays when the view moves, and serves the next one.
#pragma once

#include <transillum/render/render_solution.h>

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace transillum::viewer {

class StillPicture {
public:
    /// Passes after which a picture is left as it is, each of `bundles` bundles.
    static constexpr int passes = 32, bundles = 32;

    /// Keeps a reference. \param threads that it may keep busy
    StillPicture(const Solution& solution, int threads);
    /// Waits until the pass at hand has noticed.
    ~StillPicture();

    // None of these waits for the thread.
    /// Begins anew, with a view of that many pixels.
    void begin(const Camera& camera, int width, int height);
    /// The view moves.
    void stop();
    struct Shown {
        Image image;  ///< mean of the passes
        int pass = 0;
    };
    /// What came since the last call. \throws what ended the thread
    [[nodiscard]] std::optional<Shown> take();

private:
    struct View {
        Camera camera;
        int width = 0, height = 0;
    };
    class Stopping;

    void run(const std::stop_token& end);
    void sharpen(SolutionRenderer& renderer, const View& view, std::uint64_t number,
                 const std::stop_token& end);

    const Solution& solution_;
    const Workers workers_;

    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<View> wanted_;
    std::uint64_t number_ = 0;  ///< of what was asked for; what was begun before another is dropped
    std::optional<Shown> ready_;
    std::exception_ptr failure_;

    std::jthread thread_;  // last: it uses the others
};

}  // namespace transillum::viewer
