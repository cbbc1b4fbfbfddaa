#include <transillum/repair/defects.h>

namespace transillum {

namespace {

struct Entry {
    std::string_view name;
    bool harmful;
    std::string_view text;
};

constexpr std::array<Entry, defect_count> entries{{
    {"duplicate-vertex", false, "at the place of an earlier one; welded on reading"},
    {"near-vertex", true, "almost at the place of another that no edge joins it to: a crack"},
    {"repeated-index", true, "a triangle that names a vertex twice"},
    {"zero-area", true, "a triangle with its vertices on one line: it has no normal"},
    {"needle", false, "a very thin triangle: hardly any light is measured on it"},
    {"duplicate-face", true, "twice the same triangle: which one is seen is chance"},
    {"opposite-face", true, "the same triangle wound both ways, of one material"},
    {"two-material-wall", false, "the same triangle wound both ways: a side of each material"},
    {"nonmanifold-edge", false, "of three faces or more, as where walls meet a floor"},
    {"nonmanifold-vertex", false, "where fans of faces meet in nothing but the vertex"},
    {"flipped-edge", true, "its two faces disagree which side is the front"},
    {"border-edge", false, "of one face only: the surface is open there"},
    {"t-junction", true, "a vertex on an edge that passes it by: a crack"},
    {"self-intersection", true, "faces of one object pass through each other"},
    {"object-intersection", true, "faces of two objects pass through each other"},
    {"coplanar-overlap", true, "faces share area of one plane: which one is seen is chance"},
    {"non-orientable", true, "a component that has no consistent front"},
    {"inside-out", false, "a closed component whose fronts look inwards, as a room's do"},
    {"thin-wall", false, "a face with another close behind its back"},
    {"leak", true, "light passes a gap between outside and inside"},
}};

const Entry& entry_of(Defect defect) {
    return entries[static_cast<std::size_t>(defect)];
}

}  // namespace

std::string_view name_of(Defect defect) {
    return entry_of(defect).name;
}

std::string_view describe(Defect defect) {
    return entry_of(defect).text;
}

bool is_harmful(Defect defect) {
    return entry_of(defect).harmful;
}

}  // namespace transillum
