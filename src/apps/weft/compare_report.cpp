#include "apps/weft/compare_report.h"

#include <Imath/half.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "image/atomic_file.h"
#include "image/write.h"

namespace weft::apps {

namespace {

std::string base64(std::span<unsigned char const> bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        for (size_t j = 0; j < 3; ++j)
            group = group << 8 | (i + j < bytes.size() ? bytes[i + j] : 0);
        for (size_t j = 0; j < 4; ++j)
            text += i + j > bytes.size() ? '=' : digits[group >> (18 - 6 * j) & 63];
    }
    return text;
}

std::string data_url(int width, int height, int channels, std::vector<uint8_t> const& pixels) {
    return "data:image/png;base64," + base64(image::png_bytes(width, height, channels, pixels));
}

/// The bits of the nearest half with 8 significant bits; what is finite remains so.
uint16_t short_half(float x) {
    if (std::isfinite(x)) x = std::clamp(x, -65280.f, 65280.f);
    uint16_t const bits = Imath::half(x).bits();
    return std::isfinite(x) ? uint16_t((bits + 4) & ~7) : bits;
}

std::string light_url(image::Image const& light) {
    size_t const count = size_t(light.width) * size_t(light.height);
    std::vector<uint8_t> bytes(6 * count);
    for (size_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 3; ++c) {
            size_t const from = light.channels >= 3 ? c : 0;
            uint16_t const bits = short_half(light.pixels[i * size_t(light.channels) + from]);
            bytes[3 * i + c] = uint8_t(bits >> 8);
            bytes[3 * (count + i) + c] = uint8_t(bits & 255);
        }
    return data_url(light.width, 2 * light.height, 3, bytes);
}

std::string flip_url(image::Image const& errors) {
    std::vector<uint8_t> bytes;
    for (float e : errors.pixels) bytes.push_back(uint8_t(e * 255 + 0.5f));
    return data_url(errors.width, errors.height, 1, bytes);
}

/// File names, or whole paths where two names are the same.
std::vector<std::string> names_of(Report const& report) {
    std::vector<std::string> names;
    std::set<std::string> different;
    for (ReportPicture const& p : report.pictures) {
        names.push_back(std::filesystem::path(p.path).filename().string());
        different.insert(names.back());
    }
    if (different.size() < names.size())
        for (size_t i = 0; i < names.size(); ++i) names[i] = report.pictures[i].path;
    return names;
}

std::string json_of(Report const& report) {
    nlohmann::ordered_json json;
    json["width"] = report.pictures.front().light.width;
    json["height"] = report.pictures.front().light.height;
    json["flipKind"] = report.flip_kind;
    json["note"] = report.note;
    for (ReportMetric const& m : report.metrics)
        json["metrics"].push_back(
            {{"name", m.name}, {"help", m.help}, {"digits", m.digits}, {"whole", m.whole}});
    auto const names = names_of(report);
    for (size_t i = 0; i < names.size(); ++i) {
        ReportPicture const& p = report.pictures[i];
        nlohmann::ordered_json picture{{"name", names[i]}, {"path", p.path}};
        if (!p.metrics.empty()) picture["metrics"] = p.metrics;
        picture["data"] = light_url(p.light);
        if (!p.flip.pixels.empty()) picture["flip"] = flip_url(p.flip);
        json["pictures"].push_back(std::move(picture));
    }
    using Json = nlohmann::ordered_json;
    std::string const text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    std::string safe; // for a <script>: no file name may end it
    safe.reserve(text.size());
    for (char c : text)
        if (c == '<')
            safe += "\\u003c";
        else
            safe += c;
    return safe;
}

} // namespace

void write_report(std::string const& path, Report const& report) {
    constexpr std::string_view mark = "@DATA@";
    std::string_view const page = report_page();
    size_t const at = page.find(mark);
    std::string text(page.substr(0, at));
    text += json_of(report);
    text += page.substr(at + mark.size());
    image::replace_file(path, text);
}

} // namespace weft::apps
