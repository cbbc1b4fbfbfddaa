/// Solutions of every shape, with arbitrary values in every field.
#pragma once

#include <transillum/solution/solution.h>

#include <filesystem>
#include <map>
#include <string>

namespace transillum::test {

struct Shape {
    std::vector<int> levels{0, 2, 1};  ///< one a root
    int splits = 0;                    ///< rounds of splitting leaves at random after that
    int light_samples = 3;
    bool light_vectors = false;  ///< instead of tables, one for every two samples
    int cameras = 2;
    bool uvs = false;  ///< and textures
    bool one_sided = false;
    bool lit = true;
    bool norms = false;  ///< of a Monte-Carlo component
    int lights = 0;  ///< without extent
    Environment::Kind environment = Environment::Kind::none;
};

/// Patches of dark sides hold zeros, as loading restores them.
[[nodiscard]] Solution random_solution(const Shape& shape, unsigned seed);

/// Every field equal; names the first that is not.
void expect_equal(const Solution& a, const Solution& b);

/// A folder of its own for each call.
[[nodiscard]] std::filesystem::path fresh_folder();

/// Bytes of all files below a folder, by path relative to it.
[[nodiscard]] std::map<std::string, std::string> files_below(const std::filesystem::path& folder);

}  // namespace transillum::test
