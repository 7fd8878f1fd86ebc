#include "ViewServer.h"

#include "../common/parsing.h"
#include "ApiError.h"
#include "page_files.h"
#include <mrpt_polyloc/base/errors.h>
#include <mrpt_polyloc/base/number_text.h>
#include <mrpt_polyloc/visibility/VisibilityCells.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <functional>
#include <httplib.h>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace mrpt_polyloc::apps {
namespace {

constexpr const char* kJson = "application/json";

/// Sends a text as it is: what httplib takes as a body it compresses, which costs more than it
/// saves on the way to the same machine.
void send(httplib::Response& response, std::string text, const std::string& type) {
  const auto held = std::make_shared<const std::string>(std::move(text));
  response.set_content_provider(
      held->size(), type, [held](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(held->data() + offset, std::min(length, held->size() - offset));
      });
}

void sendJson(httplib::Response& response, const Json& json) {
  // Text from outside may be no UTF-8.
  send(response, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n", kJson);
  response.set_header("Cache-Control", "no-store");
}

void sendError(httplib::Response& response, const ApiError& error) {
  response.status = error.status;
  sendJson(response, {{"error",
                       {{"status", error.status},
                        {"code", error.code},
                        {"place", error.place},
                        {"message", error.what()}}}});
}

/// Runs what answers a request, and tells whatever it throws.
void answer(httplib::Response& response, const std::function<Json()>& make) {
  try {
    sendJson(response, make());
  } catch (const ApiError& error) {
    sendError(response, error);
  } catch (const InvalidParamsError& error) {
    sendError(response, {400, "bad_request", "", error.what()});
  } catch (const CellBudgetError& error) {
    sendError(response, {422, "too_many_cells", "", error.what()});
  } catch (const std::bad_alloc&) {
    sendError(response, {503, "no_memory", "", "not enough memory"});
  } catch (const std::exception& error) {
    sendError(response, {500, "failed", "", error.what()});
  }
}

/// The body of a request, of at most so many bytes, whatever its header says of its length.
std::string readBody(const httplib::Request& request, const httplib::Response& response,
                     const httplib::ContentReader& read) {
  const std::string type = request.get_header_value("Content-Type");
  if (type.substr(0, type.find(';')) != kJson) {
    throw ApiError(415, "not_json", "", "header Content-Type: application/json is asked for");
  }
  std::string body;
  bool is_too_long = false;
  const bool is_whole = read([&](const char* data, std::size_t size) {
    is_too_long |= body.size() + size > ViewServer::kMostBytes;
    if (!is_too_long) body.append(data, size);
    return !is_too_long;
  });
  if (is_too_long || response.status == 413) {  // httplib's verdict on the stated length
    throw ApiError(413, "too_large", "",
                   "the body has more than " + std::to_string(ViewServer::kMostBytes) + " bytes");
  }
  if (!is_whole) throw ApiError(400, "cut_short", "", "the body ends too early");
  return body;
}

nlohmann::json parseBody(const std::string& body) {
  try {
    return nlohmann::json::parse(body);
  } catch (const nlohmann::json::exception& error) {
    throw ApiError(400, "not_json", "byte", error.what());
  }
}

/// A parameter of the query that is a number of a range.
std::optional<double> numberOf(const httplib::Request& request, const char* name, double min,
                               double max) {
  if (!request.has_param(name)) return std::nullopt;
  const auto number = parseNumber(request.get_param_value(name));
  if (number && *number >= min && *number <= max) return number;
  std::ostringstream range;
  range << name << ": not a number from " << min << " to " << max;
  throw ApiError(400, "bad_request", name, range.str());
}

/// `tolerance` [m], or `pixels`, the width of a picture of the whole map, off by half of one.
double toleranceOf(const httplib::Request& request, const BoundingBox& box) {
  if (const auto tolerance = numberOf(request, "tolerance", 0.0, 1e6)) return *tolerance;
  const auto pixels = numberOf(request, "pixels", 16.0, 1e6);
  if (!pixels) return 0.0;
  return 0.5 * std::max(box.max.x - box.min.x, box.max.y - box.min.y) / *pixels;
}

std::string typeOf(std::string_view name) {
  const auto ends = [&](std::string_view end) {
    return name.size() > end.size() && name.substr(name.size() - end.size()) == end;
  };
  if (ends(".html")) return "text/html; charset=utf-8";
  if (ends(".css")) return "text/css; charset=utf-8";
  if (ends(".svg")) return "image/svg+xml";
  return "text/javascript; charset=utf-8";
}

/// Only for the message: httplib does not say why it has no port.
std::string whyNotBound(const std::string& address, int port) {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_in);
  auto* v4 = reinterpret_cast<sockaddr_in*>(&storage);
  auto* v6 = reinterpret_cast<sockaddr_in6*>(&storage);
  const auto net_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, address.c_str(), &v4->sin_addr) == 1) {
    v4->sin_family = AF_INET;
    v4->sin_port = net_port;
  } else if (::inet_pton(AF_INET6, address.c_str(), &v6->sin6_addr) == 1) {
    v6->sin6_family = AF_INET6;
    v6->sin6_port = net_port;
    size = sizeof(sockaddr_in6);
  } else {
    return "no such address";
  }
  const int fd = ::socket(storage.ss_family, SOCK_STREAM, 0);
  if (fd < 0) return std::strerror(errno);
  const int yes = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  const bool is_bound = ::bind(fd, reinterpret_cast<const sockaddr*>(&storage), size) == 0;
  const std::string why = is_bound ? "it could not be listened on" : std::strerror(errno);
  ::close(fd);
  return why;
}

}  // namespace

ViewServer::ViewServer(const Services& services, const std::string& address)
    : address_(address),
      guard_(address),
      services_(services),
      jobs_(std::max(1U, std::thread::hardware_concurrency())),
      server_(std::make_unique<httplib::Server>()) {
  server_->new_task_queue = [] { return new httplib::ThreadPool(kConnections); };
  server_->set_read_timeout(kReadSeconds);
  server_->set_write_timeout(2 * kReadSeconds);
  server_->set_keep_alive_timeout(kReadSeconds);
  server_->set_keep_alive_max_count(100'000);
  server_->set_payload_max_length(kMostBytes);
  // Head and body are sent one after the other: the second would wait for an acknowledgement of the
  // first, which comes 40 ms later.
  server_->set_tcp_nodelay(true);
  // Not httplib's default, which lets two servers share a port.
  server_->set_socket_options([this](auto socket) {
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    listening_ = socket;
  });
  server_->set_pre_routing_handler([this](const auto& request, auto& response) {
    const auto refused =
        guard_.refusal(request.get_header_value("Host"), request.get_header_value("Origin"));
    if (!refused) return httplib::Server::HandlerResponse::Unhandled;
    sendError(response, {403, "foreign", "", *refused});
    return httplib::Server::HandlerResponse::Handled;
  });
  server_->set_error_handler([](const httplib::Request&, httplib::Response& response) {
    if (response.body.empty() && response.get_header_value("Content-Type").empty()) {
      const std::string reason = response.status == 404   ? "there is nothing of that name"
                                 : response.status == 413 ? "the body is too long"
                                                          : "the request is not understood";
      response.set_content(Json{{"error",
                                 {{"status", response.status},
                                  {"code", response.status == 404 ? "not_found" : "bad_request"},
                                  {"place", ""},
                                  {"message", reason}}}}
                                   .dump() +
                               "\n",
                           kJson);
    }
  });
  server_->set_default_headers({{"X-Content-Type-Options", "nosniff"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Content-Security-Policy",
                                 "default-src 'self'; img-src 'self' blob: data:; object-src "
                                 "'none'; base-uri 'none'; frame-ancestors 'none'"}});
  addPage();
  addAnswers();
}

ViewServer::~ViewServer() = default;

void ViewServer::addPage() {
  for (const PageFile& file : pageFiles()) {
    const auto give = [file](const httplib::Request&, httplib::Response& response) {
      send(response, std::string(file.text), typeOf(file.name));
      response.set_header("Cache-Control", "no-cache");
    };
    std::string pattern = "/";
    for (const char c : file.name) pattern += c == '.' ? std::string("\\.") : std::string(1, c);
    server_->Get(pattern, give);
    if (file.name == "index.html") server_->Get("/", give);
  }
}

void ViewServer::addAnswers() {
  const std::string root = "/api/v" + std::to_string(kApiVersion) + "/";
  server_->Get(root + "health", [this](const httplib::Request&, httplib::Response& response) {
    answer(response, [this] { return answerHealth(services_); });
  });
  server_->Get(root + "map", [this](const httplib::Request& request, httplib::Response& response) {
    answer(response, [&] {
      const BoundingBox& box = services_.session.map().boundingBox();
      return answerMap(services_, toleranceOf(request, box));
    });
  });
  server_->Get(root + "cells", [this](const httplib::Request&, httplib::Response& response) {
    answer(response, [this] {
      Jobs::Ticket ticket(jobs_, "");
      return answerCells(services_, ticket);
    });
  });
  server_->Get(root + "log", [this](const httplib::Request&, httplib::Response& response) {
    answer(response, [this] { return answerLog(services_); });
  });
  using Answer = Json (*)(const Services&, const RequestField&, Jobs::Ticket&);
  const std::pair<const char*, Answer> answers[] = {
      {"localize", answerLocalize}, {"simulate", answerSimulate}, {"compare", answerCompare},
      {"view", answerView},         {"leaf", answerLeaf},         {"scan", answerScan},
      {"outcomes", answerOutcomes}, {"travel", answerTravel},     {"plan", answerPlan}};
  for (const auto& [name, give] : answers) {
    server_->Post(root + name,
                  [this, give = give](const httplib::Request& request, httplib::Response& response,
                                      const httplib::ContentReader& read) {
                    answer(response, [&] {
                      const nlohmann::json body = parseBody(readBody(request, response, read));
                      const RequestField field(body);
                      const auto job = field.find("job");
                      Jobs::Ticket ticket(jobs_, job ? job->text(64) : "");
                      return give(services_, field, ticket);
                    });
                  });
  }
}

int ViewServer::bind(int port) {
  const int bound = port == 0                               ? server_->bind_to_any_port(address_)
                    : server_->bind_to_port(address_, port) ? port
                                                            : -1;
  if (bound < 0) {
    throw std::runtime_error("cannot listen on " + address_ + ", port " + std::to_string(port) +
                             ": " + whyNotBound(address_, port));
  }
  // Httplib lets five connections wait, and more of them at once are lost.
  ::listen(listening_, static_cast<int>(kConnections));
  return bound;
}

void ViewServer::serve() {
  server_->listen_after_bind();
  has_ended_ = true;
}

void ViewServer::stop() {
  jobs_.stop();
  // Httplib does not hear it before it runs.
  while (!has_ended_ && !server_->is_running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (!has_ended_) server_->stop();
}

}  // namespace mrpt_polyloc::apps
