#include "scene/sky_light.h"

#include <charconv>

namespace weft::scene {

std::optional<Date> parse_date(std::string_view text) {
    Date date;
    int* const parts[]{&date.year, &date.month, &date.day};
    for (int* part : parts) {
        if (part != &date.year) {
            if (text.empty() || text.front() != '-') return {};
            text.remove_prefix(1);
        }
        auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), *part);
        if (error != std::errc() || *part < 1) return {};
        text.remove_prefix(size_t(end - text.data()));
    }
    if (!text.empty() || date.year < 1600 || date.year > 9999 || date.month > 12) return {};
    bool const leap = date.year % 4 == 0 && (date.year % 100 != 0 || date.year % 400 == 0);
    constexpr int days[]{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    int const last = days[date.month - 1] + (date.month == 2 && leap ? 1 : 0);
    if (date.day > last) return {};
    return date;
}

} // namespace weft::scene
