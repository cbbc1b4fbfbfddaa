/// A vector of structs as arrays, one a member.
#pragma once

#include "solution/vtk_arrays.h"

#include <string>
#include <type_traits>
#include <vector>

namespace transillum {

/// Copies one member of every element to an array, and back.
template <class Struct, class Value>
void add_member(vtkFieldData& fields, const char* name, const std::vector<Struct>& structs,
                Value Struct::*member) {
    constexpr bool is_small = std::is_same_v<Value, bool> || std::is_enum_v<Value>;
    using Stored = std::conditional_t<is_small, std::uint8_t, Value>;
    if constexpr (std::is_same_v<Value, std::string>) {
        std::vector<std::string> strings;
        strings.reserve(structs.size());
        for (const Struct& each : structs) strings.push_back(each.*member);
        add_strings(fields, name, strings);
    } else {
        add_array(fields, name, structs.size(),
                  [&](std::size_t i) { return Stored(structs[i].*member); });
    }
}

template <class Struct, class Value>
void read_member(const ArrayReader& reader, const char* name, std::vector<Struct>& structs,
                 Value Struct::*member) {
    const auto values = [&] {
        if constexpr (std::is_same_v<Value, std::string>) {
            return reader.read_strings(name, structs.size());
        } else if constexpr (std::is_same_v<Value, bool>) {
            return reader.read_flags(name, structs.size());
        } else if constexpr (std::is_enum_v<Value>) {
            return reader.read<std::uint8_t>(name, structs.size());
        } else {
            return reader.read<Value>(name, structs.size());
        }
    }();
    for (std::size_t i = 0; i < structs.size(); ++i) structs[i].*member = Value(values[i]);
}

}  // namespace transillum
