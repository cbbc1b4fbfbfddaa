#include "still_picture.h"

#include <exception>
#include <utility>

namespace transillum::viewer {

/// Says stop as soon as another view is asked for, or none.
class StillPicture::Stopping : public Monitor {
public:
    Stopping(StillPicture& owner, std::uint64_t number, const std::stop_token& end)
        : owner_(owner), number_(number), end_(end) {}
    [[nodiscard]] bool stop_requested() const override {
        const std::scoped_lock lock(owner_.mutex_);
        return end_.stop_requested() || owner_.number_ != number_;
    }

private:
    StillPicture& owner_;
    const std::uint64_t number_;
    const std::stop_token end_;
};

StillPicture::StillPicture(const Solution& solution, int threads)
    : solution_(solution),
      workers_(threads),
      thread_([this](const std::stop_token& end) { run(end); }) {}

StillPicture::~StillPicture() {
    thread_.request_stop();
    stop();
}

void StillPicture::begin(const Camera& camera, int width, int height) {
    const std::scoped_lock lock(mutex_);
    ++number_;
    ready_.reset();
    wanted_ = View{camera, width, height};
    changed_.notify_all();
}

void StillPicture::stop() {
    const std::scoped_lock lock(mutex_);
    ++number_;
    ready_.reset();
    wanted_.reset();
    changed_.notify_all();
}

std::optional<StillPicture::Shown> StillPicture::take() {
    const std::scoped_lock lock(mutex_);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    return std::exchange(ready_, std::nullopt);
}

void StillPicture::run(const std::stop_token& end) try {
    std::optional<SolutionRenderer> renderer;  // takes seconds: made when first asked for
    while (true) {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, end, [&] { return wanted_.has_value(); })) return;
        const View view = *std::exchange(wanted_, std::nullopt);
        const std::uint64_t number = number_;
        lock.unlock();
        if (!renderer) {
            RenderOptions options;
            options.samples = 8;
            options.iterations = bundles;
            options.monte_carlo = MonteCarloShading::subpatch;
            Monitor silent;
            renderer.emplace(solution_, options, workers_, silent);
        }
        sharpen(*renderer, view, number, end);
    }
} catch (...) {
    const std::scoped_lock lock(mutex_);
    failure_ = std::current_exception();
}

void StillPicture::sharpen(SolutionRenderer& renderer, const View& view, std::uint64_t number,
                           const std::stop_token& end) {
    Stopping monitor(*this, number, end);
    std::vector<SpectrumSum> sums(static_cast<std::size_t>(view.width) * view.height,
                                  SpectrumSum(0.0));
    for (int pass = 1; pass <= passes; ++pass) {
        renderer.set_picture(view.width, view.height, static_cast<std::uint64_t>(pass));
        Image image = renderer.render(view.camera, workers_, monitor);
        if (monitor.stop_requested()) return;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] += SpectrumSum(image.pixels[i]);
            image.pixels[i] = Spectrum(sums[i] / double(pass));
        }
        const std::scoped_lock lock(mutex_);
        if (number_ == number) ready_ = Shown{std::move(image), pass};
    }
}

}  // namespace transillum::viewer
