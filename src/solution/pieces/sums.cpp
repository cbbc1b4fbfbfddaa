#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>
#include <transillum/transport/plain_sums.h>

#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>

namespace transillum {

namespace {

template <class Number>
void add_tables(vtkFieldData& fields, const std::vector<NumberTable<Number>>& tables) {
    for (const auto& [name, components, values] : tables) {
        const std::size_t rows = values.size() / static_cast<std::size_t>(components);
        Number* out = new_array<Number>(fields, name.c_str(), rows, components);
        std::ranges::copy(values, out);
    }
}

template <class Number>
bool read_table(vtkAbstractArray& array, std::vector<NumberTable<Number>>& tables) {
    const auto* numbers = vtkArrayDownCast<vtkAOSDataArrayTemplate<Number>>(&array);
    if (numbers == nullptr) return false;
    const Number* first = static_cast<const Number*>(array.GetVoidPointer(0));
    tables.push_back({array.GetName(),
                      array.GetNumberOfComponents(),
                      {first, first + array.GetNumberOfValues()}});
    return true;
}

/// \pre VTK reads 64-bit integers as long long, whichever of its 64-bit types was written.
bool read_counts(vtkAbstractArray& array, std::vector<NumberTable<std::uint64_t>>& tables) {
    std::vector<NumberTable<unsigned long long>> found;
    if (!read_table(array, found)) return read_table(array, tables);
    auto& [name, components, values] = found[0];
    tables.push_back({name, components, {values.begin(), values.end()}});
    return true;
}

void require(bool is_of_solution, const char* array, const Path& file) {
    if (!is_of_solution)
        throw InputError(file.string(),
                         std::string("array '") + array + "': the sums are of another solution");
}

}  // namespace

PolyData sums_piece(const Solution& solution) {
    auto piece = PolyData::New();
    piece->SetPoints(vtkNew<vtkPoints>());  // VTK cannot read a file without
    vtkFieldData& fields = *piece->GetFieldData();
    add_strings(fields, "SceneHash", {solution.scene_hash});
    add_value(fields, "Iterations", solution.iterations);
    const EnergyBalance& first_shot = solution.continuation->first_shot;
    add_value(fields, "FirstShotEntered", first_shot.entered);
    add_value(fields, "FirstShotEscaped", first_shot.escaped);
    add_value(fields, "FirstShotBlackBacks", first_shot.black_backs);
    const PlainSums plain = plain_sums(*solution.continuation->sums);
    add_tables(fields, plain.doubles);
    add_tables(fields, plain.floats);
    add_tables(fields, plain.counts);
    return piece;
}

void read_sums_piece(vtkPolyData& piece, const Path& file, Solution& solution) {
    vtkFieldData& fields = *piece.GetFieldData();
    const ArrayReader reader{fields, file};
    require(reader.read_strings("SceneHash", 1)[0] == solution.scene_hash, "SceneHash", file);
    require(reader.read_value<std::uint64_t>("Iterations") == solution.iterations, "Iterations",
            file);
    Continuation read;
    read.first_shot.entered = reader.read_value<SpectrumSum>("FirstShotEntered");
    read.first_shot.escaped = reader.read_value<SpectrumSum>("FirstShotEscaped");
    read.first_shot.black_backs = reader.read_value<SpectrumSum>("FirstShotBlackBacks");
    PlainSums plain;
    for (int i = 0; i < fields.GetNumberOfArrays(); ++i) {
        vtkAbstractArray& array = *fields.GetAbstractArray(i);
        if (!read_table(array, plain.doubles) && !read_table(array, plain.floats))
            read_counts(array, plain.counts);
    }
    try {
        read.sums = sums_of(plain, solution.patches, solution.glossy);
    } catch (const UsageError& error) {
        throw InputError(file.string(), error.what());
    }
    solution.continuation = std::make_shared<Continuation>(std::move(read));
}

}  // namespace transillum
