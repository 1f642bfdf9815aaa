// Checks of numbers on the command line. CLI11's own let through what is not a number, since that
// is neither below a range nor above it.
#pragma once

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <limits>

namespace weft::apps {

/// Returns a check for CLI::Option::check: a number from `least` to `most`.
inline CLI::Validator number_within(double least,
                                    double most = std::numeric_limits<double>::infinity()) {
    auto const wanted = most < std::numeric_limits<double>::infinity()
                            ? fmt::format("a number from {} to {}", least, most)
                            : fmt::format("a number of at least {}", least);
    return CLI::Validator(
        [=](std::string const& text) {
            double value = 0;
            bool const good =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return good ? "" : fmt::format("expects {}, found '{}'", wanted, text);
        },
        "");
}

} // namespace weft::apps
