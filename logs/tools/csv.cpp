#include "logs/tools/csv.h"

#include <fmt/core.h>

#include <iostream>
#include <stdexcept>

#include "common/channels.h"
#include "logs/tools/csv_columns.h"
#include "logs/tools/csv_elements.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/subcommands.h"

namespace roomwise {
namespace {

/// RFC 4180: a cell with a separator in it stands in quotes, quotes doubled.
std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

void write_row(const std::vector<std::string>& cells, std::ostream& out) {
  for (std::size_t i = 0; i < cells.size(); ++i) out << (i > 0 ? "," : "") << quoted(cells[i]);
  out << '\n';
}

template <class Message>
void write_messages(const CsvRequest& request, const Channel<Message>& channel, std::ostream& out) {
  write_row(csv_header<Message>(), out);
  replay_log(request.log, [&](Bus& bus) {
    bus.subscribe(channel, [&out](const Message& message) { write_row(csv_row(message), out); });
  }).raise_complaints(request.log);
}

template <class Message>
CsvElements elements_of(const Message& message, std::string_view count) {
  CsvElements elements{.count = count, .names = {}, .rows = {}};
  MessageFields<Message>::visit(message, elements);
  return elements;
}

template <class Message>
void write_list(const CsvRequest& request, const Channel<Message>& channel, std::ostream& out) {
  CountOfList found{.wanted = request.list, .count = {}};
  MessageFields<Message>::visit(Message{}, found);
  if (found.count.empty()) {
    throw std::runtime_error(fmt::format("{} has no list '{}'", request.channel, request.list));
  }
  std::vector<std::string> header = elements_of(Message{}, found.count).names;
  header.insert(header.begin(), {"utime", "seq", "index"});
  write_row(header, out);
  const auto write_elements = [&](const Message& message) {
    auto rows = elements_of(message, found.count).rows;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].insert(rows[i].begin(), {fmt::format("{}", message.utime),
                                       fmt::format("{}", message.seq), fmt::format("{}", i)});
      write_row(rows[i], out);
    }
  };
  replay_log(request.log, [&](Bus& bus) {
    bus.subscribe(channel, write_elements);
  }).raise_complaints(request.log);
}

}  // namespace

void write_csv(const CsvRequest& request, std::ostream& out) {
  bool known = false;
  const auto write_if_asked = [&](const auto& channel) {
    if (channel.name != request.channel) return;
    known = true;
    if (request.list.empty()) {
      write_messages(request, channel, out);
    } else {
      write_list(request, channel, out);
    }
  };
  std::apply([&](const auto&... channel) { (write_if_asked(channel), ...); }, kAllChannels);
  if (!known) throw std::runtime_error(fmt::format("unknown channel '{}'", request.channel));
}

void add_csv(CLI::App& parent) {
  CLI::App& csv = *parent.add_subcommand("csv", "The messages of one channel as text, a row each.");
  const auto request = std::make_shared<CsvRequest>();
  csv.add_option("LOG", request->log, "a log")->required();
  csv.add_option("CHANNEL", request->channel, "e.g. POSE")->required();
  csv.add_option("--list", request->list, "a row for each element of this list, e.g. landmarks");
  csv.callback([request] {
    write_csv(*request, std::cout);
    if (!std::cout.flush()) throw std::runtime_error("cannot write to standard output");
  });
}

}  // namespace roomwise
