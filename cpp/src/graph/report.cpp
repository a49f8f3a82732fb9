#include "opacity/graph/report.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "opacity/graph/frame_graph.hpp"

namespace opacity {

const char* to_string(PassReport::Status status) {
    switch (status) {
        case PassReport::Status::ran:
            return "ran";
        case PassReport::Status::cached:
            return "cached";
        default:
            return "culled";
    }
}

std::string to_string(const Report& report) {
    std::size_t width = 4;
    for (const PassReport& row : report) width = std::max(width, row.name.size());
    std::string table;
    for (const PassReport& row : report) {
        char line[256];
        std::snprintf(line, sizeof line, "%-*s  %-6s  %9.2f ms  ", int(width), row.name.c_str(),
                      to_string(row.status), row.ms);
        table += line + row.why + (row.note.empty() ? "" : "  [" + row.note + "]") + "\n";
    }
    return table;
}

std::vector<ResourceMemory> FrameGraph::memory() const {
    std::vector<ResourceMemory> rows;
    for (const auto& [name, desc] : allocated_) {
        if (!needed_.contains(name)) continue;
        const std::size_t scale = content_scale(desc);
        rows.push_back({name, stored_bytes(desc), scale * scale * desc.width * desc.height});
    }
    for (const auto& [name, buffer] : buffers_)
        if (needed_.contains(name)) rows.push_back({name, buffer->size_bytes(), 0});
    std::sort(rows.begin(), rows.end(),
              [](const auto& a, const auto& b) { return a.name < b.name; });
    return rows;
}

std::string FrameGraph::graph_dot() const {
    std::string text = "digraph frame {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    std::set<std::string> nodes, edges;
    const auto source = [&](const Source& s) {
        const char* look = dynamic_cast<const Resource*>(&s) ? "shape=cylinder" : "shape=note";
        nodes.insert("  \"" + s.name() + "\" [" + look + "];\n");
        return "\"" + s.name() + "\"";
    };
    for (const Pass& pass : passes_) {
        const std::string node = "\"pass " + pass.name + "\"";
        std::string status = "not run";
        for (const PassReport& row : report_)
            if (row.name == pass.name) status = to_string(row.status);
        nodes.insert("  " + node + " [shape=box, style=" + (status == "ran" ? "bold" : "dashed") +
                     ", label=\"" + pass.name + "\\n" + status + "\"];\n");
        const auto reads = [&](const Source& s) {
            edges.insert("  " + source(s) + " -> " + node + ";\n");
        };
        const auto writes = [&](const Source& s) {
            edges.insert("  " + node + " -> " + source(s) + ";\n");
        };
        for (const Source* read : all_reads(pass)) reads(*read);
        for (const Target& target : pass.writes) writes(*target.texture);
        for (const Resource* store : pass.stores) writes(*store);
        for (const Source* value : pass.values) writes(*value);
    }
    for (const std::string& node : nodes) text += node;
    for (const std::string& edge : edges) text += edge;
    return text + "}\n";
}

}  // namespace opacity
