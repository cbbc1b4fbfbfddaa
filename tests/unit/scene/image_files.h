/// Image files, written by the tests through OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <type_traits>
#include <vector>

namespace transillum {

struct ImageShape {
    int width = 1, height = 1, channels = 3;
};

/// Writes values as they are.
template <class Value>
void write_image(const std::filesystem::path& file, const ImageShape& shape,
                 const std::vector<Value>& values,
                 const std::vector<std::pair<std::string, int>>& attributes = {}) {
    constexpr auto type = std::is_same_v<Value, float>           ? OIIO::TypeDesc::FLOAT
                          : std::is_same_v<Value, std::uint16_t> ? OIIO::TypeDesc::UINT16
                                                                 : OIIO::TypeDesc::UINT8;
    const auto image = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(image) << file;
    OIIO::ImageSpec spec(shape.width, shape.height, shape.channels, type);
    spec["oiio:UnassociatedAlpha"] = 1;
    for (const auto& [name, value] : attributes) spec[name] = value;
    ASSERT_TRUE(image->open(file.string(), spec)) << image->geterror();
    ASSERT_TRUE(image->write_image(type, values.data())) << image->geterror();
    ASSERT_TRUE(image->close()) << image->geterror();
}

}  // namespace transillum
