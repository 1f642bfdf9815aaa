// Every file in bad_gltf/ is refused with exactly the message beside it.
#include "io/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace weft;
namespace fs = std::filesystem;

namespace {

fs::path const kBad = fs::path(WEFT_SOURCE_DIR) / "tests/io/bad_gltf";

std::vector<std::string> bad_files() {
    std::vector<std::string> names;
    for (fs::directory_entry const& entry : fs::directory_iterator(kBad))
        if (io::is_gltf(entry.path().string())) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// `text` with file names instead of paths.
std::string without_folder(std::string text) {
    std::string const folder = kBad.string();
    for (size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
        bool const inside = text.substr(at + folder.size(), 1) == "/";
        text.replace(at, folder.size() + inside, inside ? "" : ".");
    }
    return text;
}

class BadGltf : public testing::TestWithParam<std::string> {};

TEST_P(BadGltf, IsRefusedWithItsMessage) {
    std::ifstream in(kBad / (GetParam() + ".expected"));
    std::string expected;
    std::getline(in, expected);
    std::string message = "no error";
    try {
        io::read_scene_file((kBad / GetParam()).string());
    } catch (InputError const& e) {
        message = without_folder(e.what());
    }
    EXPECT_EQ(message, expected);
}

INSTANTIATE_TEST_SUITE_P(All, BadGltf, testing::ValuesIn(bad_files()), [](auto const& tested) {
    std::string name = tested.param;
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
});

TEST(BadGltfFiles, CorpusIsThere) { EXPECT_GT(bad_files().size(), 80u); }

TEST(BadGltfFiles, AreRefusedCutAnywhere) {
    std::ifstream in(fs::path(WEFT_SOURCE_DIR) / "tests/fuzz/corpus/gltf/triangle.glb",
                     std::ios::binary);
    std::string const whole{std::istreambuf_iterator<char>(in), {}};
    ASSERT_FALSE(whole.empty());
    image::TextureCache textures;
    for (size_t size = 0; size < whole.size(); ++size) {
        scene::Scene scene;
        EXPECT_THROW(
            io::read_gltf(std::string_view(whole).substr(0, size), "cut.glb", "", scene, textures),
            InputError)
            << size;
    }
    scene::Scene scene;
    EXPECT_NO_THROW(io::read_gltf(whole, "whole.glb", "", scene, textures));
}

} // namespace
