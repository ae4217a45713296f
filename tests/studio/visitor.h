// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "studio/studio.h"
#include "tests/jobs/job_folders.h"

/// A garment to draw on, and a page that is no browser.
namespace furrow::tests {

using jobs::Json;

/// A level sheet of 0.4 m, hung by its border of largest y, in a folder of its own; beside it the project's.
struct Desk {
  explicit Desk(const std::string& name) : folder(empty_folder("studio_" + name)) {
    io::MeshFile sheet;
    sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.04);
    io::write_mesh(folder / "sheet.ply", sheet);
    scene.settings = io::parse_toml("[garment]\nmesh = \"sheet.ply\"\n", "test");
    scene.folder = folder;
    io::set_value(scene.settings, "pins.0", Json{{"box", {-1, 0.35, -1, 1, 1, 1}}}, "test");
  }
  std::filesystem::path project() const { return folder / "drawing"; }
  std::filesystem::path folder;
  jobs::SceneInput scene;
};

/// What a studio answers to a request; where it closes the connection while a body is sent, what it said
/// before.
inline boost::beast::http::response<boost::beast::http::string_body> answer_to(
    const studio::Studio& studio, boost::beast::http::request<boost::beast::http::string_body> request) {
  namespace http = boost::beast::http;
  boost::asio::io_context io;
  boost::beast::tcp_stream stream(io);
  stream.connect({boost::asio::ip::address_v4::loopback(), studio.port()});
  request.prepare_payload();
  boost::beast::error_code closed;
  http::write(stream, request, closed);
  boost::beast::flat_buffer buffer;
  http::response<http::string_body> response;
  http::read(stream, buffer, response, closed);
  return response;
}

/// A page that is no browser.
class Visitor {
 public:
  explicit Visitor(const studio::Studio& studio, const std::string& origin = "")
      : Visitor(studio.port(), studio.token(), origin) {}
  Visitor(unsigned short port, const std::string& token, const std::string& origin = "") : ws_(io_) {
    const std::string host = "127.0.0.1:" + std::to_string(port);
    boost::beast::get_lowest_layer(ws_).connect({boost::asio::ip::address_v4::loopback(), port});
    ws_.set_option(boost::beast::websocket::stream_base::decorator([&](auto& request) {
      request.set(boost::beast::http::field::origin, origin.empty() ? "http://" + host : origin);
    }));
    ws_.handshake(host, "/ws?token=" + token);
  }

  void send(const std::string& text) { ws_.write(boost::asio::buffer(text)); }
  /// The answer to a message; meshes and states that come before it are kept.
  Json ask(const std::string& what, Json body = Json::object()) {
    body["do"] = what;
    body["id"] = ++id_;
    send(body.dump());
    return answer();
  }
  Json answer() {
    for (;;) {
      boost::beast::flat_buffer buffer;
      ws_.read(buffer);
      const std::string text = boost::beast::buffers_to_string(buffer.data());
      if (ws_.got_binary()) {
        if (text.at(4) == 0) cloth = text;
        if (text.at(4) == 1) {
          body = text;
          ++bodies;
        }
        if (text.at(4) == 2) preview = text;
        if (text.at(4) == 3) ++moved;
        if (text.at(4) == 4) colours = text;
        continue;
      }
      Json message = Json::parse(text);
      if (message.contains("status")) status = message["status"];
      if (message.contains("id")) return message;
    }
  }

  /// Until the cloth is seen to move; false: an answer came first.
  bool sees_motion() {
    boost::beast::flat_buffer buffer;
    for (const int before = moved; moved == before; buffer.clear()) {
      ws_.read(buffer);
      const std::string text = boost::beast::buffers_to_string(buffer.data());
      if (ws_.got_binary() && text.at(4) == 3) ++moved;
      if (!ws_.got_binary() && Json::parse(text).contains("id")) return false;
    }
    return true;
  }

  Json status;
  int moved = 0;      ///< frames of moving cloth
  std::string cloth;  ///< the last mesh of it
  std::string body;   ///< that is shown
  int bodies = 0;     ///< meshes of it
  std::string preview;
  std::string colours;

 private:
  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> ws_;
  int id_ = 0;
};

inline Json line_at(double x, double height = 0.02) {
  return {{"height", height}, {"width", 0.08}, {"points", {{x, 0.1, 0.0}, {x, 0.2, 0.0}, {x, 0.3, 0.0}}}};
}

inline Json saved_strokes(const std::filesystem::path& folder) {
  return Json::parse(bytes_of(folder / "strokes.json")).at("strokes");
}

}  // namespace furrow::tests
