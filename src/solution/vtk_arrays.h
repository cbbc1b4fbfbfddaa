/// Values of ours to and from named VTK arrays. A value is a number or a GLM vector or std::array
/// of numbers; its parts become the array's components.
#pragma once

#include <vtkAOSDataArrayTemplate.h>
#include <vtkFieldData.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

namespace transillum {

template <class Value>
struct PartOf {
    using Type = typename Value::value_type;
};
template <class Value>
requires std::is_arithmetic_v<Value>
struct PartOf<Value> {
    using Type = Value;
};
template <class Value>
using Part = typename PartOf<Value>::Type;

template <class Value>
inline constexpr int part_count = static_cast<int>(sizeof(Value) / sizeof(Part<Value>));

/// A new array of `fields`; its zeros are for the caller to fill.
template <class Number>
Number* new_array(vtkFieldData& fields, const char* name, std::size_t tuples, int components) {
    const auto array = vtkSmartPointer<vtkDataArray>::Take(
        vtkDataArray::CreateDataArray(vtkTypeTraits<Number>::VTK_TYPE_ID));
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
    fields.AddArray(array);
    return static_cast<Number*>(array->GetVoidPointer(0));
}

/// \param value_of gives the value of an index below `count`.
template <class ValueOf>
void add_array(vtkFieldData& fields, const char* name, std::size_t count, ValueOf value_of) {
    using Value = std::decay_t<std::invoke_result_t<ValueOf, std::size_t>>;
    using Number = Part<Value>;
    Number* out = new_array<Number>(fields, name, count, part_count<Value>);
    for (std::size_t i = 0; i < count; ++i, out += part_count<Value>) {
        const Value value = value_of(i);
        std::memcpy(out, &value, sizeof(Value));
    }
}

template <class Value>
void add_value(vtkFieldData& fields, const char* name, const Value& value) {
    add_array(fields, name, 1, [&](std::size_t) { return value; });
}

void add_strings(vtkFieldData& fields, const char* name, const std::vector<std::string>& values);

/// Reads arrays by name; whatever is not as expected throws InputError naming file and array.
struct ArrayReader {
    vtkFieldData& fields;
    const std::filesystem::path& file;

    [[nodiscard]] bool has(const char* name) const;

    template <class Value>
    [[nodiscard]] std::vector<Value> read(const char* name, std::size_t count) const {
        // Found first: a damaged count must not ask for memory.
        const Part<Value>* parts = find<Part<Value>>(name, count, part_count<Value>);
        std::vector<Value> values(count);
        if (count > 0) std::memcpy(values.data(), parts, count * sizeof(Value));
        return values;
    }

    /// As many as there are.
    template <class Value>
    [[nodiscard]] std::vector<Value> read(const char* name) const {
        return read<Value>(name, count_of(name));
    }

    template <class Value>
    [[nodiscard]] Value read_value(const char* name) const {
        return read<Value>(name, 1)[0];
    }

    /// Bytes that are 0 or 1.
    [[nodiscard]] std::vector<std::uint8_t> read_flags(const char* name, std::size_t count) const;
    [[nodiscard]] std::vector<std::string> read_strings(const char* name) const;
    [[nodiscard]] std::vector<std::string> read_strings(const char* name, std::size_t count) const;

    /// The numbers of an array of exactly that type and shape.
    template <class Number>
    [[nodiscard]] const Number* find(const char* name, std::size_t tuples, int components) const {
        vtkAbstractArray& array = find_array(name);
        check_shape(array, vtkTypeTraits<Number>::VTK_TYPE_ID, tuples, components);
        return static_cast<const Number*>(array.GetVoidPointer(0));
    }

private:
    [[nodiscard]] vtkAbstractArray& find_array(const char* name) const;
    [[nodiscard]] std::size_t count_of(const char* name) const;
    void check_shape(vtkAbstractArray& array, int type, std::size_t tuples, int components) const;
};

}  // namespace transillum
