// Weights of a trained network in the file format of Intel Open Image Denoise (TZA, version 2).
//
// A file is, little-endian: magic 0x41d7 (16 bits), major and minor version (8 bits each), the
// offset of the table (64 bits); the table is a count (32 bits) and for each tensor: length of the
// name (16 bits), name, number of dimensions n (8 bits), n sizes (32 bits each), n characters that
// name the dimensions ("oihw", "x"), one for the type ("f" float, "h" half), the offset of the
// values (64 bits).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace weft::post {

struct Tensor {
    std::vector<int64_t> dims; ///< weights: output channels, input channels, height, width
    std::vector<float> values; ///< the last dimension varies fastest
};

using Weights = std::map<std::string, Tensor>;

/// Throws InputError where the file is missing, or is not as described.
Weights read_weights(std::string const& path);

/// The same for the bytes of a file; `name` stands for its path in messages.
Weights parse_weights(std::string_view bytes, std::string const& name);

/// The folders that are searched for weights, in order: `first` where it is not empty,
/// $WEFT_WEIGHTS where it is set, $XDG_DATA_HOME/weft/weights or else ~/.local/share/weft/weights,
/// share/weft/weights beside the folder of the program, and weft/weights in each of $XDG_DATA_DIRS,
/// /usr/local/share and /usr/share where it is not set.
std::vector<std::string> weight_folders(std::string const& first = "");

/// The path of `file` in the first of the folders that has it, or "".
std::string find_weights(std::string const& file, std::vector<std::string> const& folders);

} // namespace weft::post
