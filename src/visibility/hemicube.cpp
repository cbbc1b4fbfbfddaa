#include <transillum/base/error.h>
#include <transillum/visibility/hemicube.h>

#include "visibility/scan_convert.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

namespace transillum {

/// A face at distance 1; pixel (x, y) looks along forward + s * right + t * up.
struct Hemicube::Face {
    glm::dvec3 right, up, forward;
    glm::dvec3 zenith;  ///< the hemicube's axis
    int width, height;  ///< [pixels]
    double bottom;      ///< t of the lower edge: -1, or 0 where the horizon is
    double pixel;       ///< edge of a pixel

    [[nodiscard]] glm::dvec3 towards(int x, int y) const {
        return forward + right * ((x + 0.5) * pixel - 1.0) + up * ((y + 0.5) * pixel + bottom);
    }
    /// Cosine-weighted solid angle of a pixel: cos / |d|^3 dA, cos = d.zenith / |d|.
    [[nodiscard]] double weight(const glm::dvec3& d) const {
        const double squared = glm::dot(d, d);
        return pixel * pixel * glm::dot(d, zenith) / (squared * squared);
    }
};

namespace {

constexpr std::uint32_t nothing = 0xffffffffu;
/// Triangles are clipped at this multiple of a face's half width, and scissored within it.
constexpr double guard_band = 4.0;
constexpr std::uint32_t enough_pixels = 64;
/// Heights over a plane that rounding alone can make, relative to the coordinates they come from.
constexpr double rounding = 64.0 * std::numeric_limits<double>::epsilon();

struct Outline {
    std::array<glm::dvec3, 9> p;
    int count = 0;
};

/// Keeps what lies where dot(p, plane) >= 0.
Outline clip(const Outline& in, const glm::dvec3& plane, double offset) {
    Outline out;
    for (int i = 0; i < in.count; ++i) {
        const glm::dvec3 &a = in.p[i], &b = in.p[(i + 1) % in.count];
        const double da = glm::dot(a, plane) - offset, db = glm::dot(b, plane) - offset;
        if (da >= 0.0) out.p[out.count++] = a;
        if ((da < 0.0) != (db < 0.0)) out.p[out.count++] = a + (b - a) * (da / (da - db));
    }
    return out;
}

/// In face coordinates: what is in front and within the guard band.
Outline clip_to_guard_band(Outline outline, double nearest) {
    outline = clip(outline, {0, 0, 1}, nearest);
    for (const glm::dvec3& plane : {glm::dvec3(1, 0, guard_band), glm::dvec3(-1, 0, guard_band),
                                    glm::dvec3(0, 1, guard_band), glm::dvec3(0, -1, guard_band)}) {
        if (outline.count < 3) break;
        outline = clip(outline, plane, 0.0);
    }
    return outline;
}

}  // namespace

Hemicube::Hemicube(const SurfaceMesh& mesh, const PatchHierarchy& patches, int resolution)
    : mesh_(mesh),
      patches_(patches),
      resolution_(resolution),
      sums_(patches.patch_count()),
      views_(patches.patch_count()) {
    for (std::uint32_t leaf = 0; leaf < patches.leaf_count; ++leaf)
        leaf_area_.push_back(area_of_leaf(mesh, patches, leaf));
    if (resolution < 16 || resolution > 4096 || resolution % 2 != 0)
        throw UsageError("hemicube resolution " + std::to_string(resolution) +
                         "; accepted: 16 to 4096, even");
    pixels_.resize(6);
    weights_.resize(6);
}

Hemicube::~Hemicube() = default;

const std::vector<PatchView>& Hemicube::look(const glm::dvec3& position, const glm::dmat3& frame) {
    position_ = position;
    frame_ = frame;
    distribution_ = nullptr;
    const double pixel = 2.0 / resolution_;
    const glm::dvec3 &x = frame[0], &y = frame[1], &z = frame[2];
    const int half = resolution_ / 2;
    look_through({{x, y, z, z, resolution_, resolution_, -1.0, pixel},
                  {y, z, x, z, resolution_, half, 0.0, pixel},
                  {-y, z, -x, z, resolution_, half, 0.0, pixel},
                  {-x, z, y, z, resolution_, half, 0.0, pixel},
                  {x, z, -y, z, resolution_, half, 0.0, pixel}});
    keep_flux();
    return views_;
}

/// Patches of few pixels, or none, have their share but for an error: together they would receive
/// more than is sent, or less.
void Hemicube::keep_flux() {
    double sent = 0.0, arriving = 0.0;
    for (std::uint32_t p = 0; p < views_.size(); ++p) {
        sent += sums_[p].seen;
        arriving += leaf_area_[patches_.leaf_of_patch(p)] * double{views_[p].mean_kernel} *
                    views_[p].visibility;
    }
    if (!(arriving > 0.0)) return;
    const auto factor = static_cast<float>(sent / arriving);
    for (PatchView& view : views_) view.mean_kernel *= factor;
}

const std::vector<PatchView>& Hemicube::look_around(const glm::dvec3& position,
                                                    const glm::dmat3& frame,
                                                    const Distribution& distribution) {
    position_ = position;
    frame_ = frame;
    distribution_ = &distribution;
    const double pixel = 2.0 / resolution_;
    const glm::dvec3 &x = frame[0], &y = frame[1], &z = frame[2];
    std::vector<Face> faces;
    for (const auto& [right, up, forward] :
         {std::array{x, y, z}, {y, x, -z}, {y, z, x}, {-y, z, -x}, {-x, z, y}, {x, z, -y}})
        faces.push_back({right, up, forward, z, resolution_, resolution_, -1.0, pixel});
    const std::vector<PatchView>& views = look_through(std::move(faces));
    distribution_ = nullptr;
    return views;
}

const std::vector<PatchView>& Hemicube::look_through(std::vector<Face> faces) {
    faces_ = std::move(faces);
    std::fill(sums_.begin(), sums_.end(), PatchSums{});
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        pixels_[i].assign(std::size_t{1} * faces_[i].width * faces_[i].height,
                          {std::numeric_limits<float>::infinity(), nothing});
        if (distribution_) weigh_pixels(i);
        // Nothing shines through it: a spot is narrow.
        const bool is_dark =
            distribution_ && std::ranges::all_of(weights_[i], [](float w) { return w == 0.0f; });
        if (!is_dark) draw_face(faces_[i]);
    }
    for (const Face& face : faces_) add_seen(face);
    for (std::uint32_t p = 0; p < sums_.size(); ++p)
        views_[p] = sums_[p].pixels > 0 ? view_of(sums_[p], p) : view_of_missed(p);
    return views_;
}

/// Solid angle of the pixels times the distribution: pixel^2 / |d|^3.
void Hemicube::weigh_pixels(std::size_t face) {
    const Face& f = faces_[face];
    std::vector<float>& weights = weights_[face];
    weights.clear();
    for (int y = 0; y < f.height; ++y)
        for (int x = 0; x < f.width; ++x) {
            const glm::dvec3 d = f.towards(x, y);
            const double squared = glm::dot(d, d), length = std::sqrt(squared);
            weights.push_back(static_cast<float>((*distribution_)(d / length) * f.pixel * f.pixel /
                                                 (squared * length)));
        }
}

double Hemicube::weight(std::size_t face, std::size_t pixel, const glm::dvec3& d) const {
    return distribution_ ? double{weights_[face][pixel]} : faces_[face].weight(d);
}

void Hemicube::draw_face(const Face& face) {
    for (std::uint32_t root = 0; root < mesh_.triangles.size(); ++root) draw_root(face, root);
}

void Hemicube::draw_root(const Face& face, std::uint32_t root) {
    const auto& vertices = mesh_.triangles[root].vertices;
    Outline outline;
    outline.count = 3;
    std::array<glm::dvec3, 3> corner;
    for (int i = 0; i < 3; ++i) {
        corner[i] = mesh_.positions[vertices[i]] - position_;
        outline.p[i] = {glm::dot(corner[i], face.right), glm::dot(corner[i], face.up),
                        glm::dot(corner[i], face.forward)};
    }
    const double size =
        std::max({std::abs(outline.p[0].z), std::abs(outline.p[1].z), std::abs(outline.p[2].z)});
    outline = clip_to_guard_band(outline, size * 1e-9);
    if (outline.count < 3) return;

    // The plane of the root and its barycentric coordinates, as linear functions of the point.
    const glm::dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const glm::dvec3 area_normal = glm::cross(e1, e2);
    const double height = glm::dot(area_normal, corner[0]);
    // Edge-on but for rounding: the plane the point itself lies on, which it may lie a little
    // behind.
    const double coordinates = glm::length(position_) + glm::length(corner[0]);
    if (std::abs(height) <= rounding * glm::length(area_normal) * coordinates) return;
    const glm::dvec3 normal = glm::normalize(area_normal);
    const double per_area = 1.0 / glm::dot(area_normal, area_normal);
    const glm::dvec3 to_b1 = glm::cross(e2, area_normal) * per_area,
                     to_b2 = glm::cross(area_normal, e1) * per_area;
    const bool back = height > 0.0;
    const std::uint32_t side = back ? patches_.leaf_count : 0;
    const auto number = static_cast<std::size_t>(&face - faces_.data());
    auto& pixels = pixels_[number];

    const auto span = [&](std::int32_t y, std::int32_t x0, std::int32_t x1) {
        for (std::int32_t x = x0; x < x1; ++x) {
            const glm::dvec3 d = face.towards(x, y);
            const double facing = glm::dot(d, area_normal);
            const double t = height / facing;
            if (!(t > 0.0)) continue;
            const glm::dvec3 hit = d * t - corner[0];
            const std::uint32_t patch =
                side + patches_.leaf_at(root, static_cast<float>(glm::dot(hit, to_b1)),
                                        static_cast<float>(glm::dot(hit, to_b2)));
            const double squared = glm::dot(d, d);
            PatchSums& s = sums_[patch];
            const std::size_t at = static_cast<std::size_t>(y) * face.width + x;
            ++s.pixels;
            s.covered += weight(number, at, d);
            // dA = r^2 d(omega) / cos' with r = t |d|, d(omega) = pixel^2 / |d|^3, cos' = |d.n| /
            // |d|
            s.area += face.pixel * face.pixel * t * t / std::abs(glm::dot(d, normal));
            Pixel& pixel = pixels[at];
            const auto distance = static_cast<float>(t * std::sqrt(squared));
            if (distance < pixel.distance) pixel = {distance, patch};
        }
    };
    std::array<FixedPoint, 9> fixed;
    const double unit = (1 << sub_pixel_bits) / face.pixel;
    for (int i = 0; i < outline.count; ++i) {
        const glm::dvec3& p = outline.p[i];
        // Pixel centres lie at multiples of 256.
        fixed[i] = {static_cast<std::int32_t>(std::lrint((p.x / p.z + 1.0) * unit)) -
                        (1 << (sub_pixel_bits - 1)),
                    static_cast<std::int32_t>(std::lrint((p.y / p.z - face.bottom) * unit)) -
                        (1 << (sub_pixel_bits - 1))};
    }
    for (int i = 1; i + 1 < outline.count; ++i) {
        std::array<FixedPoint, 3> triangle{fixed[0], fixed[i], fixed[i + 1]};
        const std::int64_t area = twice_area(triangle[0], triangle[1], triangle[2]);
        if (area == 0) continue;
        if (area < 0) std::swap(triangle[1], triangle[2]);
        for (int y = 0; y < face.height; y += tile_size)
            for (int x = 0; x < face.width; x += tile_size)
                scan_convert(triangle, sub_pixel_bits,
                             {x, y, std::min(x + tile_size, face.width),
                              std::min(y + tile_size, face.height)},
                             span);
    }
}

void Hemicube::add_seen(const Face& face) {
    const auto number = static_cast<std::size_t>(&face - faces_.data());
    const auto& pixels = pixels_[number];
    for (int y = 0; y < face.height; ++y)
        for (int x = 0; x < face.width; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * face.width + x;
            const std::uint32_t patch = pixels[at].patch;
            if (patch != nothing) sums_[patch].seen += weight(number, at, face.towards(x, y));
        }
}

/// Share of a leaf's area above the hemicube's horizon.
double Hemicube::front_share(std::uint32_t leaf) const {
    Outline outline;
    outline.count = 3;
    const auto corners = points_of_leaf(mesh_, patches_, leaf);
    int below = 0;
    for (int i = 0; i < 3; ++i) {
        outline.p[i] = corners[i] - position_;
        below += glm::dot(outline.p[i], frame_[2]) < 0.0;
    }
    if (below == 0) return 1.0;
    if (below == 3) return 0.0;
    const Outline above = clip(outline, frame_[2], 0.0);
    glm::dvec3 area(0.0);
    for (int i = 1; i + 1 < above.count; ++i)
        area += glm::cross(above.p[i] - above.p[0], above.p[i + 1] - above.p[0]);
    return 0.5 * glm::length(area) / area_of_leaf(mesh_, patches_, leaf);
}

/// Flux over the patch's area where there are pixels enough, which keeps the flux; else over the
/// area behind its own pixels: their errors cancel. So for a distribution, whose point has no
/// others beside it to make up for its errors.
PatchView Hemicube::view_of(const PatchSums& sums, std::uint32_t patch) const {
    const std::uint32_t leaf = patches_.leaf_of_patch(patch);
    const double kernel = distribution_ ? sums.covered / sums.area
                          : sums.pixels >= enough_pixels
                              ? sums.covered / leaf_area_[leaf]
                              : sums.covered / sums.area * front_share(leaf);
    if (!(sums.covered > 0.0)) return {};
    return {static_cast<float>(kernel),
            static_cast<float>(std::min(1.0, sums.seen / sums.covered))};
}

/// Is a patch that shows one side behind something that shows the other, in the pixels about it? At
/// the outline of a closed body they may see past it, but its far half is behind its near one.
bool Hemicube::is_inside(const Face& face, int x, int y, std::uint32_t patch,
                         double distance) const {
    const auto& pixels = pixels_[static_cast<std::size_t>(&face - faces_.data())];
    for (int row = std::max(0, y - 1); row < std::min(face.height, y + 2); ++row)
        for (int column = std::max(0, x - 1); column < std::min(face.width, x + 2); ++column) {
            const Pixel& p = pixels[static_cast<std::size_t>(row) * face.width + column];
            if (p.patch != nothing && patches_.is_back(p.patch) != patches_.is_back(patch) &&
                p.distance * (1.0 + face.pixel) < distance)
                return true;
        }
    return false;
}

/// A patch between pixel centres: its centre, looked up in the nearest pixel.
PatchView Hemicube::view_of_missed(std::uint32_t patch) const {
    const std::uint32_t leaf = patches_.leaf_of_patch(patch), root = patches_.root_of_leaf[leaf];
    const glm::dvec3 d = leaf_centre(mesh_, patches_, leaf) - position_;
    const double squared = glm::dot(d, d), distance = std::sqrt(squared);
    const double up =
        distribution_ ? distance * (*distribution_)(d / distance) : glm::dot(d, frame_[2]);
    const double facing =
        glm::dot(d, normal_of(mesh_, root)) * (patches_.is_back(patch) ? 1.0 : -1.0);
    const double least = rounding * (glm::length(position_) + distance);
    if (up <= (distribution_ ? 0.0 : least) || facing <= least) return {};
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const Face& face = faces_[i];
        const double forward = glm::dot(d, face.forward);
        if (forward <= 0.0) continue;
        const double x = std::floor((glm::dot(d, face.right) / forward + 1.0) / face.pixel);
        const double y = std::floor((glm::dot(d, face.up) / forward - face.bottom) / face.pixel);
        if (x < 0.0 || y < 0.0 || x >= face.width || y >= face.height) continue;
        const Pixel& pixel =
            pixels_[i][static_cast<std::size_t>(y) * face.width + static_cast<std::size_t>(x)];
        // Within a pixel's width of what is seen there.
        const bool seen =
            distance <= pixel.distance * (1.0 + face.pixel) &&
            !is_inside(face, static_cast<int>(x), static_cast<int>(y), patch, distance);
        return {static_cast<float>(up * facing / (squared * squared)), seen ? 1.0f : 0.0f};
    }
    return {};
}

}  // namespace transillum
