#include "cli/web_server.h"

#include <transillum/base/error.h>
#include <transillum/solution/load_solution.h>

#include <fmt/format.h>
#include <httplib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>
#include <utility>

namespace transillum::cli {

namespace {

namespace fs = std::filesystem;
constexpr const char* address = "127.0.0.1";
constexpr std::array<std::pair<const char*, const char*>, 4> types{
    {{".html", "text/html; charset=utf-8"},
     {".js", "text/javascript"},
     {".css", "text/css"},
     {".vtm", "application/xml"}}};

std::string read_file(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (!in) throw IoError(file.string(), "cannot be read");
    return bytes;
}

std::string type_of(const fs::path& file) {
    const auto found = std::ranges::find_if(
        types, [&](const auto& type) { return file.extension() == type.first; });
    return found == types.end() ? "application/octet-stream" : found->second;
}

/// Where the page is: beside the program's folder.
fs::path page_folder() {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    const fs::path folder = program.parent_path().parent_path() / "share" / "transillum" / "web";
    if (!fs::exists(folder / "index.html"))
        throw IoError(folder.string(), "the web viewer is missing; ./run build makes it, with npm");
    return folder;
}

/// What a request may ask for, and the file that it gets.
using Served = std::map<std::string, fs::path>;

Served served_files(const fs::path& file) {
    if (!fs::is_regular_file(file)) throw IoError(file.string(), "cannot be read: no such file");
    const std::string extension = file.extension().string();
    if (extension != ".vtm" && extension != ".vtp" && extension != ".glb" && extension != ".ply")
        throw UsageError(file.string() +
                         "; accepted: a name that ends in .vtm, .vtp, .glb or .ply");
    Served served{{"/solution/" + file.filename().string(), file}};
    if (extension != ".vtm") return served;
    (void)load_solution(file);  // what is wrong with it is better said here
    const fs::path folder = fs::path(file).replace_extension();
    if (!fs::is_directory(folder))
        throw InputError(file.string(), "names pieces in another folder than " + folder.string() +
                                            "; accepted: NAME.vtm beside its folder NAME");
    for (const auto& piece : fs::directory_iterator(folder))
        if (piece.is_regular_file() && !piece.is_symlink())
            served["/solution/" + folder.filename().string() + "/" +
                   piece.path().filename().string()] = piece.path();
    return served;
}

/// As the value of an attribute.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '"')
            result.append("&quot;");
        else if (c == '&')
            result.append("&amp;");
        else
            result.push_back(c);
    }
    return result;
}

/// The page, told what to open.
std::string page_of(const fs::path& folder, const fs::path& file) {
    std::string page = read_file(folder / "index.html");
    const std::string before = "<title>";
    const std::size_t at = page.find(before);
    if (at == std::string::npos) throw InputError((folder / "index.html").string(), "is no page");
    return page.insert(
        at, "<meta name=\"solution\" content=\"" + escaped(file.filename().string()) + "\">\n");
}

}  // namespace

struct WebServer::Listening {
    httplib::Server server;
    int port = 0;
    std::thread thread;
};

WebServer::WebServer(const fs::path& file, int port) : listening_(std::make_unique<Listening>()) {
    Served served = served_files(file);
    const fs::path folder = page_folder();
    const std::string page = page_of(folder, file);
    for (const char* name : {"main.js", "viewer.css"})
        served[std::string("/") + name] = folder / name;
    httplib::Server& server = listening_->server;
    const Listening* const listening = listening_.get();
    server.Get(".*", [=](const httplib::Request& request, httplib::Response& response) {
        // A name of this machine that another site made up must not read what is here.
        const std::string host = request.get_header_value("Host");
        constexpr int usual_port = 80;  // which clients leave out
        const std::string at =
            listening->port == usual_port ? "" : fmt::format(":{}", listening->port);
        if (host != address + at && host != "localhost" + at) {
            response.status = 403;
            return response.set_content("host " + host + "; accepted: " + address + at + "\n",
                                        "text/plain");
        }
        response.set_header("Cache-Control", "no-store");
        if (request.path == "/" || request.path == "/index.html")
            return response.set_content(page, type_of("index.html"));
        const auto found = served.find(request.path);
        if (found == served.end()) {
            response.status = 404;
            return response.set_content("not served\n", "text/plain");
        }
        try {
            response.set_content(read_file(found->second), type_of(found->second));
        } catch (const IoError& e) {
            response.status = 404;
            response.set_content(std::string(e.what()) + "\n", "text/plain");
        }
    });
    // Idle connections hold a thread each.
    server.set_keep_alive_timeout(1);
    server.set_read_timeout(1);
    // The library's own let a second server on the same port take every other request.
    server.set_socket_options([](socket_t socket) {
        const int on = 1;
        setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    const bool bound = port == 0 ? (listening_->port = server.bind_to_any_port(address)) > 0
                                 : server.bind_to_port(address, listening_->port = port);
    if (!bound)
        throw IoError(fmt::format("{}:{}", address, port),
                      "cannot be listened to: is another server there? accepted: another --port, "
                      "or 0 for any that is free");
    listening_->thread = std::thread([this] { listening_->server.listen_after_bind(); });
    while (!server.is_running()) std::this_thread::yield();
}

WebServer::~WebServer() {
    listening_->server.stop();
    if (listening_->thread.joinable()) listening_->thread.join();
}

std::string WebServer::url() const {
    return fmt::format("http://{}:{}/", address, listening_->port);
}

bool WebServer::is_running() const {
    return listening_->server.is_running();
}

}  // namespace transillum::cli
