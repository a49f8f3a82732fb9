#include "opacity/graph/frame_graph.hpp"

#include <algorithm>
#include <chrono>

#include "opacity/core/error.hpp"

namespace opacity {
namespace {

std::set<const Source*> all_outputs(const Pass& pass) {
    std::set<const Source*> outputs{pass.values.begin(), pass.values.end()};
    outputs.insert(pass.stores.begin(), pass.stores.end());
    for (const Target& target : pass.writes) outputs.insert(target.texture);
    return outputs;
}

// The list without whose shapes the pass has nothing to do, if it is empty.
const DrawList* empty_list(const Pass& pass) {
    for (const DrawList* list : {pass.draws, pass.only_with})
        if (list && list->shapes().empty()) return list;
    return nullptr;
}

bool feeds(const Pass& pass, const std::set<const Source*>& needed) {
    const auto outputs = all_outputs(pass);
    return std::any_of(outputs.begin(), outputs.end(),
                       [&](const Source* output) { return needed.contains(output); });
}

template <class Names>
std::string joined(const Names& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + std::string{name};
    return text;
}

}  // namespace

Reads all_reads(const Pass& pass) {
    Reads reads = pass.reads;
    reads.insert(reads.end(), pass.camera_reads.begin(), pass.camera_reads.end());
    if (pass.view) reads.push_back(pass.view);
    if (pass.tests && std::find(reads.begin(), reads.end(), pass.tests) == reads.end())
        reads.push_back(pass.tests);
    if (pass.draws) reads.push_back(&pass.draws->geometry);
    if (pass.only_with) reads.push_back(&pass.only_with->geometry);
    return reads;
}

FrameGraph::~FrameGraph() {
    for (const auto& [name, texture] : textures_) device_.release(*texture);
    for (const auto& [name, buffer] : buffers_) device_.release(*buffer);
}

void FrameGraph::begin() {
    passes_.clear();
    declared_.clear();
}

FrameGraph::Scope::Scope(FrameGraph& graph, const std::string& name)
    : graph_{graph}, outer_{graph.prefix_} {
    graph_.prefix_ += name + "/";
}

Texture& FrameGraph::texture(const std::string& name, const TextureDesc& desc) {
    const std::string full_name = prefix_ + name;
    declared_.insert(full_name);
    auto& texture = textures_[full_name];
    if (!texture) texture = std::make_unique<Texture>(full_name, desc);
    texture->describe(desc);
    return *texture;
}

Texture& FrameGraph::growing_texture(const std::string& name, Format format) {
    const auto found = textures_.find(prefix_ + name);
    return texture(
        name, found != textures_.end() ? found->second->desc() : TextureDesc{.format = format});
}

Buffer& FrameGraph::buffer(const std::string& name) {
    const std::string full_name = prefix_ + name;
    declared_.insert(full_name);
    auto& buffer = buffers_[full_name];
    if (!buffer) buffer = std::make_unique<Buffer>(full_name);
    return *buffer;
}

void FrameGraph::add(Pass pass) {
    pass.name = prefix_ + pass.name;
    check(pass);
    passes_.push_back(std::move(pass));
}

void FrameGraph::check(const Pass& pass) const {
    const auto fail = [&](const std::string& problem, const std::string& fix) {
        throw ParameterError("pass \"" + pass.name + "\" " + problem, fix);
    };
    const bool has_stage = !pass.shader.vertex.empty() || !pass.shader.compute.empty();
    if (pass.draws && (!pass.view || !has_stage))
        fail("draws " + pass.draws->name() + " without a view or a shader",
             "set .view and .shader.vertex, or .shader.compute, beside .draws");
    if (!pass.draws && !pass.execute)
        fail("does nothing", "give it .draws, or .execute = [](PassContext&) { ... }");
    const Reads reads = all_reads(pass);
    for (const Source* output : all_outputs(pass))
        if (std::find(reads.begin(), reads.end(), output) != reads.end())
            fail("reads \"" + output->name() + "\", which it writes itself",
                 "write to a second resource and read the first");
    std::map<std::string, const Source*> resources;
    for (const Source* read : pass.reads) {
        if (pass.shader == Shader{} || !dynamic_cast<const Resource*>(read)) continue;
        const Source* first = resources.emplace(read->shader_name(), read).first->second;
        if (first != read)
            fail("reads \"" + first->name() + "\" and \"" + read->name() + "\", both t_" +
                     read->shader_name() + " in GLSL",
                 "rename one of the two");
    }
    for (const Pass& earlier : passes_) {
        if (earlier.name == pass.name) fail("is declared twice", "rename one of the two");
        for (const Target& mine : pass.writes)
            for (const Target& theirs : earlier.writes)
                if (mine.texture == theirs.texture && mine.layer == theirs.layer)
                    fail("writes \"" + mine.texture->name() + "\", which \"" + earlier.name +
                             "\" writes",
                         "one writer a texture layer: declare a second texture");
    }
}

std::set<const Source*> FrameGraph::needed_for(const Goals& goals) const {
    std::set<const Source*> needed{goals.begin(), goals.end()};
    for (auto pass = passes_.rbegin(); pass != passes_.rend(); ++pass) {
        if (!feeds(*pass, needed)) continue;
        // A pass that writes some layers of a texture needs the writers of the others.
        const auto outputs = all_outputs(*pass);
        needed.insert(outputs.begin(), outputs.end());
        const Reads reads = all_reads(*pass);
        needed.insert(reads.begin(), reads.end());
    }
    return needed;
}

std::vector<FrameGraph::Read> FrameGraph::reads_now(const Pass& pass) const {
    std::vector<Read> reads;
    if (!pass.shader.vertex.empty() || !pass.shader.compute.empty())
        reads.push_back({"shaders", shader_revision_});
    for (const Source* read : all_reads(pass)) reads.push_back({read->name(), read->revision()});
    return reads;
}

bool FrameGraph::allocated_as_described(const Texture& texture) const {
    const auto found = allocated_.find(texture.name());
    return found != allocated_.end() && found->second == texture.desc();
}

void FrameGraph::allocate(const Texture& texture) {
    if (allocated_as_described(texture)) return;
    allocated_.erase(texture.name());
    device_.allocate(texture);
    allocated_[texture.name()] = texture.desc();
    // Whoever wrote another of its layers has lost what it wrote.
    for (const Pass& pass : passes_)
        if (const auto record = records_.find(pass.name);
            record != records_.end() && all_outputs(pass).contains(&texture))
            record->second.output_lost = true;
}

bool FrameGraph::outputs_intact(const Pass& pass) const {
    for (const Source* output : all_outputs(pass)) {
        const auto* texture = dynamic_cast<const Texture*>(output);
        if (texture && !allocated_as_described(*texture)) return false;
    }
    return true;
}

void FrameGraph::run(const Goals& goals) {
    drop_undeclared();
    shader_revision_ = device_.shader_revision();
    report_.clear();
    const std::set<const Source*> needed = needed_for(goals);
    std::vector<std::string> names;
    for (const Resource* goal : goals) names.push_back("\"" + goal->name() + "\"");
    needed_.clear();
    for (const Source* source : needed) needed_.insert(source->name());
    for (const Pass& pass : passes_) {
        const bool is_needed = feeds(pass, needed);
        report_.push_back(step(pass, is_needed));
        if (!is_needed)
            report_.back().why = "nothing that " + joined(names) + " needs reads its output";
    }
}

PassReport FrameGraph::step(const Pass& pass, bool needed) {
    using Status = PassReport::Status;
    if (!needed) return {.name = pass.name, .status = Status::culled};
    Record now{pass.shader, pass.state, pass.writes, reads_now(pass), {}, false};
    const auto last = records_.find(pass.name);
    const DrawList* empty = empty_list(pass);
    const std::string no_shapes = empty ? "no " + empty->name() : "";
    if (last != records_.end() && last->second.same_input(now) && !last->second.output_lost &&
        outputs_intact(pass))
        return {pass.name, empty ? Status::culled : Status::cached,
                empty ? no_shapes : "no read moved", 0.0, last->second.note};

    const std::string why = last == records_.end() ? "first run" : why_again(last->second, now);
    if (interrupt_check_) interrupt_check_();
    records_.erase(pass.name);  // forgotten first: a pass that throws stays to be run
    const std::size_t calls_before = device_.calls();
    const auto start = std::chrono::steady_clock::now();
    now.note = execute(pass, empty);
    device_.finish();
    const std::chrono::duration<double, std::milli> elapsed =
        std::chrono::steady_clock::now() - start;
    PassReport row{
        pass.name, empty ? Status::culled : Status::ran, empty ? no_shapes : why, elapsed.count(),
        now.note,  device_.calls() - calls_before};
    records_[pass.name] = std::move(now);
    return row;
}

std::string FrameGraph::why_again(const Record& last, const Record& now) {
    std::vector<std::string> moved;
    if (last.shader != now.shader) moved.push_back("its shader");
    if (last.state != now.state) moved.push_back("its state");
    for (const Read& read : now.reads)
        if (std::find(last.reads.begin(), last.reads.end(), read) == last.reads.end())
            moved.push_back(read.name);
    if (!moved.empty()) return "moved: " + joined(moved);
    return last.same_input(now) ? "its output was described anew" : "other reads or targets";
}

void FrameGraph::run_on_cpu(const Pass& pass, PassContext& context) {
    if (!pass.on_cpu)
        throw ParameterError("\"" + pass.name + "\" runs on a GPU only",
                             "choose device=\"gpu\", or another technique");
    pass.on_cpu(context);
}

std::string FrameGraph::execute(const Pass& pass, bool clear_only) {
    for (const Source* output : all_outputs(pass))
        if (const auto* texture = dynamic_cast<const Texture*>(output)) allocate(*texture);
    if (!pass.writes.empty()) device_.clear(pass);
    PassContext context{*this, pass};
    if (clear_only) {
        for (Resource* store : pass.stores)
            if (auto* texture = dynamic_cast<Texture*>(store)) context.zero(*texture);
    } else if (!device_.runs_shaders() && pass.shader != Shader{}) {
        run_on_cpu(pass, context);
    } else if (pass.execute) {
        pass.execute(context);
    } else {
        context.draw();
    }
    if (!clear_only) context.note_hidden_chunks();
    for (const Target& target : pass.writes) target.texture->touch();
    for (Resource* store : pass.stores) store->touch();
    return context.note_;
}

void FrameGraph::drop_undeclared() {
    const auto drop = [this](auto& resources) {
        std::erase_if(resources, [this](const auto& entry) {
            if (declared_.contains(entry.first)) return false;
            device_.release(*entry.second);
            allocated_.erase(entry.first);
            return true;
        });
    };
    drop(textures_);
    drop(buffers_);
    std::erase_if(values_, [this](const auto& entry) { return !declared_.contains(entry.first); });
    std::erase_if(records_, [this](const auto& entry) {
        return std::none_of(passes_.begin(), passes_.end(),
                            [&](const Pass& pass) { return pass.name == entry.first; });
    });
}

const Texture& FrameGraph::find(const std::string& name) const {
    const auto found = textures_.find(name);
    if (found != textures_.end() && allocated_.contains(name)) return *found->second;
    std::vector<std::string> names;
    for (const auto& [known, texture] : textures_)
        if (allocated_.contains(known)) names.push_back(known);
    throw ParameterError("there is no texture \"" + name + "\"",
                         names.empty() ? "render a frame first" : "choose one of " + joined(names));
}

}  // namespace opacity
