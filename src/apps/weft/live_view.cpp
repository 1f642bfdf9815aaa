#include "apps/weft/live_view.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include "image/write.h"

namespace weft::apps {

namespace {

/// A packet of tev's protocol (its src/Ipc.cpp): the size of the whole, the kind, and then strings
/// that end with a zero and numbers of 32 bits, little-endian.
class Packet {
  public:
    enum Kind : uint8_t { UpdateImage = 3, CreateImage = 4 };

    explicit Packet(Kind kind) : bytes_(4, '\0') { bytes_ += char(kind); }
    void flag(bool v) { bytes_ += char(v); }
    void text(std::string const& v) { bytes_.append(v.c_str(), v.size() + 1); }
    template <class T>
    void number(T v) {
        static_assert(sizeof v == 4);
        bytes_.append(reinterpret_cast<char const*>(&v), 4);
    }
    std::string take() {
        auto const size = uint32_t(bytes_.size());
        std::memcpy(bytes_.data(), &size, 4);
        return std::move(bytes_);
    }

  private:
    std::string bytes_;
};

constexpr char const* kChannels[]{"R", "G", "B"};

std::string create_packet(std::string const& name, int width, int height) {
    Packet p(Packet::CreateImage);
    p.flag(true); // come to the front
    p.text(name);
    p.number(int32_t(width));
    p.number(int32_t(height));
    p.number(int32_t(3));
    for (char const* channel : kChannels) p.text(channel);
    return p.take();
}

std::string update_packet(std::string const& name, image::Image const& image, int channel) {
    Packet p(Packet::UpdateImage);
    p.flag(false);
    p.text(name);
    p.text(kChannels[channel]);
    for (int v : {0, 0, image.width, image.height}) p.number(int32_t(v));
    for (size_t i = size_t(channel); i < image.pixels.size(); i += 3) p.number(image.pixels[i]);
    return p.take();
}

int connect_to(std::string const& address) {
    size_t const colon = address.rfind(':');
    std::string const host = address.substr(0, colon),
                      port = colon == std::string::npos ? "14158" : address.substr(colon + 1);
    addrinfo hints = {}, *found = nullptr;
    hints.ai_socktype = SOCK_STREAM;
    if (int const e = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); e != 0)
        throw InputError("--tev expects host:port, found '" + address + "': " + gai_strerror(e));
    int connected = -1, error = 0;
    for (addrinfo const* i = found; i && connected < 0; i = i->ai_next) {
        int const s = ::socket(i->ai_family, i->ai_socktype | SOCK_CLOEXEC, i->ai_protocol);
        if (s >= 0 && ::connect(s, i->ai_addr, i->ai_addrlen) == 0) {
            connected = s;
        } else {
            error = errno;
            if (s >= 0) ::close(s);
        }
    }
    ::freeaddrinfo(found);
    if (connected < 0)
        throw InputError("--tev: nobody listens at '" + address + "': " + std::strerror(error));
    // A viewer that hangs must not hold up the end of a render.
    timeval const patience{10, 0};
    ::setsockopt(connected, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    return connected;
}

} // namespace

WatchedPicture::WatchedPicture(std::string path, post::DisplayChain chain)
    : path_(std::move(path)), chain_(std::move(chain)) {
    image::check_writable(path_);
}

void WatchedPicture::show(image::Image const& beauty) {
    try {
        post::write_picture(path_, beauty, chain_, {});
        told_.clear();
    } catch (std::exception const& e) {
        if (told_ != e.what())
            fmt::print(stderr, "\nwarning: the picture to watch was not written: {}\n", e.what());
        told_ = e.what();
    }
}

session::Watcher WatchedPicture::watcher() {
    return {2, [this](session::RenderState const& state) { show(state.film.mean()); }};
}

TevClient::TevClient(std::string const& address, std::string name)
    : name_(std::move(name)), socket_(connect_to(address)) {}

TevClient::~TevClient() {
    if (socket_ >= 0) ::close(socket_);
}

bool TevClient::send(std::string const& packet) {
    for (size_t at = 0; at < packet.size();) {
        ssize_t const n = ::send(socket_, packet.data() + at, packet.size() - at, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) {
            fmt::print(stderr, "\nwarning: the viewer is gone: {}\n", std::strerror(errno));
            ::close(socket_);
            socket_ = -1;
            return false;
        }
        at += size_t(n);
    }
    return true;
}

void TevClient::show(film::Film const& film) {
    image::Image const image = film.mean();
    if (socket_ < 0) return;
    if (!created_ && !send(create_packet(name_, image.width, image.height))) return;
    created_ = true;
    for (int c = 0; c < 3; ++c)
        if (!send(update_packet(name_, image, c))) return;
}

session::Watcher TevClient::watcher() {
    return {1, [this](session::RenderState const& state) { show(state.film); }};
}

LiveViews::LiveViews(LiveArguments const& a, post::DisplayChain const& chain,
                     std::string const& name) {
    if (!a.watch.empty()) file_.emplace(a.watch, chain);
    if (!a.tev.empty()) tev_.emplace(a.tev, name);
}

void LiveViews::watch(std::vector<session::Watcher>& watchers) {
    if (file_) watchers.push_back(file_->watcher());
    if (tev_) watchers.push_back(tev_->watcher());
}

void LiveViews::show(film::Film const& film) {
    if (tev_) tev_->show(film);
    if (file_) file_->show(film.mean());
}

} // namespace weft::apps
