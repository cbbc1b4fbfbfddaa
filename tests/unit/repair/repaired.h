/// What the tests of repairs do with scenes.
#pragma once

#include <transillum/repair/repair_scene.h>

#include "repair/defects/find_defects.h"
#include "repair/exact/find_intersections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace transillum::testing_support {

inline RepairedScene repair(const Scene& scene, const RepairOptions& options = {},
                            int threads = 2) {
    Monitor silent;
    return repair_scene(scene, options, Workers(threads), silent);
}

inline double area_of(const Scene& scene) {
    const TriangleSoup soup = make_soup(scene);
    double sum = 0.0;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t)
        sum += 0.5 * glm::length(area_vector(soup, t));
    return sum;
}

inline void expect_sound(const Scene& scene) {
    const TriangleSoup soup = make_soup(scene);
    for (const FaultyFace& f : find_faulty_faces(soup, scene)) EXPECT_EQ(f.fault, FaceFault::none);
    EXPECT_THAT(find_intersections(soup, Workers(2)), testing::IsEmpty());
}

}  // namespace transillum::testing_support
