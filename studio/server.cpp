// SPDX-License-Identifier: GPL-3.0-or-later
#include "studio/server.h"

#include <pthread.h>
#include <unistd.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "io/base/field_words.h"
#include "jobs/base/inputs.h"
#include "studio/frame_bytes.h"
#include "studio/message.h"
#include "studio/page_files.h"
#include "studio/page_words.h"
#include "studio/uploads.h"
#include "studio/worker.h"

namespace furrow::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr std::size_t most_pages = 32, longest_queue = 4096;
constexpr std::size_t most_silent = 32;                  // connections of which a request is awaited
constexpr auto first_silence = std::chrono::seconds(5);  // until a connection asks for anything
constexpr auto later_silence = std::chrono::seconds(30);

std::string random_token() {
  unsigned char bytes[32];  // 256 bits
  if (getentropy(bytes, sizeof bytes) != 0) throw std::runtime_error("the system gives no random numbers");
  std::string token;
  for (const unsigned char b : bytes)
    for (const int digit : {b >> 4, b & 15}) token += "0123456789abcdef"[digit];
  return token;
}

/// In a time that does not tell how much of it is right.
bool same_token(std::string_view a, std::string_view b) {
  unsigned char differs = a.size() != b.size();
  for (std::size_t i = 0; i < b.size(); ++i)
    differs |= static_cast<unsigned char>((i < a.size() ? a[i] : 0) ^ b[i]);
  return differs == 0;
}

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// A request's target: path, and what its query says.
struct Target {
  std::string_view path, token, name;
};
Target parse_target(std::string_view target) {
  const std::size_t question = target.find('?');
  Target parsed{target.substr(0, question), {}, {}};
  if (question == std::string_view::npos) return parsed;
  const std::string_view query = target.substr(question + 1);
  if (query.substr(0, 6) != "token=") return parsed;
  const std::size_t next = query.find("&name=");
  parsed.token = query.substr(6, query.find('&') - 6);
  if (next != std::string_view::npos) parsed.name = query.substr(next + 6);
  return parsed;
}

Response answer_to(const Request& request, http::status status, std::string_view type, std::string body) {
  Response answer(status, request.version());
  answer.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  answer.set(http::field::cache_control, "no-store");
  answer.set("X-Content-Type-Options", "nosniff");
  answer.set("Referrer-Policy", "no-referrer");
  answer.set("Cross-Origin-Resource-Policy", "same-origin");
  answer.set("Content-Security-Policy",
             "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' "
             "data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  answer.keep_alive(request.keep_alive() && status == http::status::ok);
  answer.body() = std::move(body);
  answer.prepare_payload();
  return answer;
}

Response plain(const Request& request, http::status status, const std::string& words) {
  return answer_to(request, status, "text/plain; charset=utf-8", words + "\n");
}

/// The page without its token: one that was loaded again has it in its session's storage (again.js).
Response no_token(const Request& request, bool is_page) {
  if (!is_page) return plain(request, http::status::forbidden, "403: the token is missing or wrong");
  return answer_to(
      request, http::status::forbidden, "text/html; charset=utf-8",
      "<!doctype html><html lang=en><meta charset=utf-8><title>Furrow</title><p>This page opens with "
      "the whole address that furrow studio printed.<script src=/again.js></script></html>");
}

}  // namespace

struct Server::Parts {
  explicit Parts(unsigned short wanted) : acceptor(io) {
    const tcp::endpoint here(asio::ip::address_v4::loopback(), wanted);
    acceptor.open(here.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(here);
    acceptor.listen();
    port = acceptor.local_endpoint().port();
  }
  bool is_own_host(std::string_view host) const {
    const std::string end = ":" + std::to_string(port);
    return host == "127.0.0.1" + end || host == "localhost" + end;
  }
  bool is_own_origin(std::string_view origin) const {
    return origin.substr(0, 7) == "http://" && is_own_host(origin.substr(7));
  }
  void accept();
  /// The one that has been silent for longest makes room, so that silence keeps nobody out.
  void make_room();

  std::size_t open = 0;                         ///< pages; before `io`, as those that end with it count down
  std::map<std::uint64_t, Connection*> silent;  ///< of which a request is awaited, by when that began
  std::uint64_t next_silence = 0;
  asio::io_context io{1};
  tcp::acceptor acceptor;
  unsigned short port = 0;
  std::string token = random_token();
  Worker* worker = nullptr;
  Uploads* uploads = nullptr;
  std::map<Client, std::weak_ptr<Page>> pages;
  Client next = 1;
  std::thread thread;
};

/// A page's WebSocket, and what waits to be sent to it.
class Page : public std::enable_shared_from_this<Page> {
 public:
  Page(beast::tcp_stream&& stream, Server::Parts& server)
      : ws_(std::move(stream)), server_(server), client_(server.next++) {
    ++server_.open;
  }
  ~Page() { --server_.open; }

  void run(const Request& request) {
    ws_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    ws_.read_message_max(largest_message + 1024);
    ws_.auto_fragment(false);  // a mesh of 1 MB came in 250 parts
    ws_.async_accept(request, [self = shared_from_this()](beast::error_code failed) {
      if (failed) return;
      self->server_.pages[self->client_] = self;
      self->server_.worker->greet(self->client_);
      self->read();
    });
  }

  /// One that waits of the same kind gives way; to the cloth itself, what it did on the way there, too.
  void send(Bytes bytes, bool binary) {
    const auto kind = [](const Bytes& b) { return b->size() > 4 ? ShownAs((*b)[4]) : ShownAs::cloth; };
    const ShownAs newer = kind(bytes);
    if (binary && queue_.size() > 1)
      std::erase_if(queue_, [&, first = &queue_.front()](const Out& out) {
        if (&out == first || !out.binary) return false;
        const ShownAs older = kind(out.bytes);
        const bool of_body = older == ShownAs::body || older == ShownAs::moving_body;
        return older == newer || (newer == ShownAs::cloth && !of_body) || (newer == ShownAs::body && of_body);
      });
    if (queue_.size() >= longest_queue) return close();
    queue_.push_back({std::move(bytes), binary});
    if (queue_.size() == 1) write();
  }
  void close() { beast::get_lowest_layer(ws_).close(); }

 private:
  struct Out {
    Bytes bytes;
    bool binary;
  };
  void read() {
    ws_.async_read(buffer_, [self = shared_from_this()](beast::error_code failed, std::size_t) {
      if (failed) return self->leave();
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      if (self->ws_.got_text())
        self->server_.worker->post(self->client_, text);
      else
        self->send(std::make_shared<const std::string>(
                       R"({"id":null,"refused":"binary messages are not understood"})"),
                   false);
      self->read();
    });
  }
  void write() {
    ws_.binary(queue_.front().binary);
    ws_.async_write(asio::buffer(*queue_.front().bytes),
                    [self = shared_from_this()](beast::error_code failed, std::size_t) {
                      if (failed) return self->leave();
                      self->queue_.pop_front();
                      if (!self->queue_.empty()) self->write();
                    });
  }
  void leave() {
    if (server_.pages.erase(client_)) server_.worker->leave(client_);
    close();
  }

  websocket::stream<beast::tcp_stream> ws_;
  Server::Parts& server_;
  Client client_;
  beast::flat_buffer buffer_;
  std::deque<Out> queue_;
};

/// A connection that asks for files, until it asks for the WebSocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket&& socket, Server::Parts& server) : stream_(std::move(socket)), server_(server) {}
  ~Connection() { server_.silent.erase(silence_); }

  void read() {
    stream_.expires_after(parser_ ? later_silence : first_silence);
    parser_.emplace();
    parser_->header_limit(16 << 10);
    parser_->body_limit(largest_upload);
    silence_ = ++server_.next_silence;
    server_.silent[silence_] = this;
    http::async_read_header(stream_, buffer_, *parser_,
                            [self = shared_from_this()](beast::error_code failed, std::size_t) {
                              self->server_.silent.erase(self->silence_);
                              if (failed == http::error::body_limit) return self->refuse_size();
                              if (!failed) self->answer(self->parser_->get());
                            });
  }
  void close() { stream_.close(); }

 private:
  void answer(const Request& request) {
    const Target target = parse_target(view(request.target()));
    const bool uploads = request.method() == http::verb::put && target.path == "/upload";
    if (!server_.is_own_host(view(request[http::field::host])))
      return send(
          plain(request, http::status::misdirected_request, "421: this is not the host that you asked"));
    if (request.method() != http::verb::get && !uploads)
      return send(plain(request, http::status::method_not_allowed, "405: only GET is answered"));
    if (!uploads && !parser_->is_done())
      return send(plain(request, http::status::bad_request, "400: what is asked for has no body"));
    const bool is_helper = target.path == "/again.js";
    if (!is_helper && !same_token(target.token, server_.token))
      return send(no_token(request, target.path == "/"));
    if (uploads) return take_file(request, std::string(target.name));
    if (target.path == "/ws") return upgrade(request);
    const PageFile* file = find_page_file(target.path);
    if (!file) return send(plain(request, http::status::not_found, "404: there is no such file"));
    std::string body(file->bytes);
    for (std::size_t at; target.path == "/" && (at = body.find("TOKEN")) != std::string::npos;)
      body.replace(at, 5, server_.token);
    Response response = answer_to(request, http::status::ok, file->type, std::move(body));
    if (file->gzipped) response.set(http::field::content_encoding, "gzip");
    send(std::move(response));
  }

  void refuse_size() {
    send(plain(parser_->get(), http::status::payload_too_large, "413: a file may have 64 MiB"));
  }

  /// Reads a file that a page sends, and answers with what stands for it.
  void take_file(const Request& request, std::string name) {
    if (!server_.is_own_origin(view(request[http::field::origin])))
      return send(plain(request, http::status::forbidden, "403: the page is of another origin"));
    file_.emplace(std::move(*parser_));
    file_->body_limit(largest_upload);
    stream_.expires_after(std::chrono::seconds(120));
    http::async_read(
        stream_, buffer_, *file_, [self = shared_from_this(), name](beast::error_code failed, std::size_t) {
          Request asked;
          asked.version(11);
          if (failed == http::error::body_limit)
            return self->send(plain(asked, http::status::payload_too_large, "413: a file may have 64 MiB"));
          if (failed) return;
          const std::string number = self->server_.uploads->put(name, std::move(self->file_->get().body()));
          self->file_.reset();
          if (number.empty())
            return self->send(plain(asked, http::status::unsupported_media_type,
                                    "415: the name of a mesh ends in " + io::mesh_formats()));
          self->send(answer_to(asked, http::status::ok, "text/plain; charset=utf-8", number));
        });
  }

  void upgrade(const Request& request) {
    if (!websocket::is_upgrade(request))
      return send(plain(request, http::status::bad_request, "400: this address takes a WebSocket"));
    if (!server_.is_own_origin(view(request[http::field::origin])))
      return send(plain(request, http::status::forbidden, "403: the page is of another origin"));
    if (server_.open >= most_pages)
      return send(plain(request, http::status::service_unavailable,
                        "503: " + std::to_string(most_pages) + " pages are open already; close one"));
    stream_.expires_never();
    std::make_shared<Page>(std::move(stream_), server_)->run(request);
  }

  void send(Response&& response) {
    response_ = std::move(response);
    http::async_write(stream_, *response_,
                      [self = shared_from_this()](beast::error_code failed, std::size_t) {
                        if (failed || self->response_->need_eof()) {
                          beast::error_code ignored;
                          self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                          return;
                        }
                        self->read();
                      });
  }

  beast::tcp_stream stream_;
  Server::Parts& server_;
  std::uint64_t silence_ = 0;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  std::optional<http::request_parser<http::string_body>> file_;
  std::optional<Response> response_;
};

void Server::Parts::accept() {
  acceptor.async_accept([this](beast::error_code failed, tcp::socket socket) {
    if (failed == asio::error::operation_aborted) return;
    if (!failed) std::make_shared<Connection>(std::move(socket), *this)->read();
    make_room();
    accept();
  });
}

void Server::Parts::make_room() {
  if (silent.size() <= most_silent) return;
  silent.begin()->second->close();
  silent.erase(silent.begin());
}

Server::Server(unsigned short port) {
  try {
    parts_ = std::make_shared<Parts>(port);
  } catch (const boost::system::system_error& e) {
    throw std::runtime_error("port " + std::to_string(port) + " of 127.0.0.1 cannot be had: " +
                             e.code().message() + "; leave out --port for a free one");
  }
}

Server::~Server() { stop(); }

void Server::start(Worker& worker, Uploads& uploads) {
  parts_->worker = &worker;
  parts_->uploads = &uploads;
  parts_->accept();
  parts_->thread = std::thread([p = parts_] { p->io.run(); });
  pthread_setname_np(parts_->thread.native_handle(),
                     "studio-server");  // so that its cost can be told from the worker's
}

void Server::stop() {
  if (!parts_->thread.joinable()) return;
  parts_->io.stop();
  parts_->thread.join();
}

unsigned short Server::port() const { return parts_->port; }
const std::string& Server::token() const { return parts_->token; }

void Server::tell(Client client, const jobs::Json& message) {
  send(client,
       std::make_shared<const std::string>(
           io::with_texts(message, in_page).dump(-1, ' ', false, jobs::Json::error_handler_t::replace)),
       false);
}

void Server::show(Client client, Bytes frame) { send(client, std::move(frame), true); }

void Server::send(Client client, Bytes bytes, bool binary) {
  asio::post(parts_->io, [p = parts_.get(), client, bytes = std::move(bytes), binary] {
    for (const auto& [id, page] : p->pages)
      if (client == everybody || client == id)
        if (const auto here = page.lock()) here->send(bytes, binary);
  });
}

}  // namespace furrow::studio
