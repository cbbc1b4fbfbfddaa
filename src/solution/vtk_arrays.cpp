#include "vtk_arrays.h"

#include <transillum/base/error.h>

#include <vtkNew.h>
#include <vtkStringArray.h>

namespace transillum {

namespace {

std::string shape(vtkIdType tuples, int components, const char* type) {
    return std::to_string(tuples) + " x " + std::to_string(components) + " of type " + type;
}

/// VTK reads 64-bit integers as long long, whichever of its 64-bit types was written.
bool holds(vtkAbstractArray& array, int type) {
    const auto* numbers = vtkArrayDownCast<vtkDataArray>(&array);
    if (numbers == nullptr) return false;
    const int found = array.GetDataType();
    return vtkDataArray::GetDataTypeSize(found) == vtkDataArray::GetDataTypeSize(type) &&
           vtkDataArray::GetDataTypeMin(found) == vtkDataArray::GetDataTypeMin(type) &&
           vtkDataArray::GetDataTypeMax(found) == vtkDataArray::GetDataTypeMax(type);
}

}  // namespace

void add_strings(vtkFieldData& fields, const char* name, const std::vector<std::string>& values) {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    for (const std::string& value : values) array->InsertNextValue(value);
    fields.AddArray(array);
}

bool ArrayReader::has(const char* name) const {
    return fields.GetAbstractArray(name) != nullptr;
}

vtkAbstractArray& ArrayReader::find_array(const char* name) const {
    vtkAbstractArray* array = fields.GetAbstractArray(name);
    if (array == nullptr) {
        throw InputError(file.string(), "array '" + std::string(name) + "' is missing");
    }
    return *array;
}

void ArrayReader::check_shape(vtkAbstractArray& array, int type, std::size_t tuples,
                              int components) const {
    const auto wanted = static_cast<vtkIdType>(tuples);
    if (holds(array, type) && array.GetNumberOfTuples() == wanted &&
        array.GetNumberOfComponents() == components) {
        return;
    }
    throw InputError(file.string(),
                     "array '" + std::string(array.GetName()) + "' is " +
                         shape(array.GetNumberOfTuples(), array.GetNumberOfComponents(),
                               array.GetDataTypeAsString()) +
                         ", expected " +
                         shape(wanted, components, vtkImageScalarTypeNameMacro(type)));
}

std::size_t ArrayReader::count_of(const char* name) const {
    return static_cast<std::size_t>(find_array(name).GetNumberOfTuples());
}

std::vector<std::uint8_t> ArrayReader::read_flags(const char* name, std::size_t count) const {
    auto flags = read<std::uint8_t>(name, count);
    for (const std::uint8_t flag : flags) {
        if (flag > 1) {
            throw InputError(file.string(), "array '" + std::string(name) + "': " +
                                                std::to_string(flag) + " is neither 0 nor 1");
        }
    }
    return flags;
}

std::vector<std::string> ArrayReader::read_strings(const char* name) const {
    auto* strings = vtkArrayDownCast<vtkStringArray>(&find_array(name));
    if (strings == nullptr) {
        throw InputError(file.string(), "array '" + std::string(name) + "' holds no text");
    }
    std::vector<std::string> values;
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i) {
        values.push_back(strings->GetValue(i));
    }
    return values;
}

std::vector<std::string> ArrayReader::read_strings(const char* name, std::size_t count) const {
    auto values = read_strings(name);
    if (values.size() != count) {
        throw InputError(file.string(), "array '" + std::string(name) + "' has " +
                                            std::to_string(values.size()) + " entries, expected " +
                                            std::to_string(count));
    }
    return values;
}

}  // namespace transillum
