#include "pieces.h"

#include "solution/vtk_arrays.h"

#include <transillum/base/error.h>
#include <transillum/base/srgb.h>

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <array>
#include <optional>

namespace transillum {

namespace {

using Bytes = std::array<std::uint8_t, 3>;
using ByteTable = std::array<float, 256>;

/// What the numbers of a file stand for. Most images are bytes to begin with; those that still are
/// go back to bytes, a twelfth of the size before compression.
enum class Encoding : std::uint8_t { linear_float, linear_bytes, srgb_bytes };

ByteTable decoding_table(Encoding encoding) {
    ByteTable table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float share = static_cast<float>(i) / 255.0f;
        table[i] = encoding == Encoding::srgb_bytes ? linear_from_srgb(share) : share;
    }
    return table;
}

/// Empty unless every value is one of the table's.
std::optional<std::vector<Bytes>> encode(const std::vector<Spectrum>& texels, Encoding encoding) {
    const ByteTable table = decoding_table(encoding);
    std::vector<Bytes> bytes(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        for (int c = 0; c < channel_count; ++c) {
            const auto found = std::ranges::lower_bound(table, texels[i][c]);
            if (found == table.end() || *found != texels[i][c]) return std::nullopt;
            bytes[i][static_cast<std::size_t>(c)] =
                static_cast<std::uint8_t>(found - table.begin());
        }
    }
    return bytes;
}

std::vector<Spectrum> decode(const std::vector<Bytes>& bytes, Encoding encoding) {
    const ByteTable table = decoding_table(encoding);
    std::vector<Spectrum> texels;
    texels.reserve(bytes.size());
    for (const Bytes& b : bytes) texels.emplace_back(table[b[0]], table[b[1]], table[b[2]]);
    return texels;
}

/// VTK's rows run upwards, a Texture's downwards.
template <class Value>
void turn_rows(std::vector<Value>& values, int width) {
    const auto row = static_cast<std::ptrdiff_t>(width);
    for (auto low = values.begin(), high = values.end() - row; low < high; low += row, high -= row)
        std::swap_ranges(low, low + row, high);
}

template <class Value>
void add_texels(vtkImageData& piece, Encoding encoding, std::vector<Value> values, int width) {
    turn_rows(values, width);
    add_array(*piece.GetPointData(), "Texels", values.size(),
              [&](std::size_t i) { return values[i]; });
    piece.GetPointData()->SetActiveScalars("Texels");
    add_value(*piece.GetFieldData(), "Encoding", static_cast<std::uint8_t>(encoding));
}

template <class Value>
std::vector<Value> read_texels(vtkImageData& piece, const Path& file, int width,
                               std::size_t count) {
    auto values = ArrayReader{*piece.GetPointData(), file}.read<Value>("Texels", count);
    turn_rows(values, width);
    return values;
}

std::uint8_t read_choice(const ArrayReader& reader, const char* name, std::uint8_t last) {
    const auto value = reader.read_value<std::uint8_t>(name);
    if (value > last)
        throw InputError(reader.file.string(), "array '" + std::string(name) +
                                                   "': " + std::to_string(value) + ", at most " +
                                                   std::to_string(last) + " is accepted");
    return value;
}

}  // namespace

ImageData texture_piece(const Texture& texture) {
    auto piece = ImageData::New();
    piece->SetDimensions(texture.width, texture.height, 1);
    vtkFieldData& fields = *piece->GetFieldData();
    add_strings(fields, "Name", {texture.name});
    add_value(fields, "WrapU", static_cast<std::uint8_t>(texture.wrap_u));
    add_value(fields, "WrapV", static_cast<std::uint8_t>(texture.wrap_v));
    for (const Encoding encoding : {Encoding::srgb_bytes, Encoding::linear_bytes}) {
        if (auto bytes = encode(texture.texels, encoding)) {
            add_texels(*piece, encoding, std::move(*bytes), texture.width);
            return piece;
        }
    }
    add_texels(*piece, Encoding::linear_float, texture.texels, texture.width);
    return piece;
}

Texture read_texture_piece(vtkImageData& piece, const Path& file) {
    Texture texture;
    std::array<int, 3> size{};
    piece.GetDimensions(size.data());
    if (size[0] < 1 || size[1] < 1 || size[2] != 1)
        throw InputError(file.string(), "an image of " + std::to_string(size[0]) + " x " +
                                            std::to_string(size[1]) + " x " +
                                            std::to_string(size[2]) +
                                            " points, expected a flat one");
    texture.width = size[0];
    texture.height = size[1];
    const ArrayReader fields{*piece.GetFieldData(), file};
    texture.name = fields.read_strings("Name", 1)[0];
    texture.wrap_u = Texture::Wrap{read_choice(fields, "WrapU", 2)};
    texture.wrap_v = Texture::Wrap{read_choice(fields, "WrapV", 2)};
    const auto encoding = Encoding{read_choice(fields, "Encoding", 2)};
    const auto count = static_cast<std::size_t>(piece.GetNumberOfPoints());
    texture.texels = encoding == Encoding::linear_float
                         ? read_texels<Spectrum>(piece, file, texture.width, count)
                         : decode(read_texels<Bytes>(piece, file, texture.width, count), encoding);
    return texture;
}

std::vector<std::uint32_t> used_textures(const SurfaceMesh& surface) {
    std::vector<std::uint32_t> used;
    for (const Material& m : surface.materials)
        for (const std::int32_t texture :
             {m.textures.diffuse, m.textures.specular, m.textures.roughness, m.textures.emission})
            if (texture >= 0) used.push_back(static_cast<std::uint32_t>(texture));
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    return used;
}

std::string texture_piece_name(std::size_t number) {
    return "texture-" + std::to_string(number);
}

}  // namespace transillum
