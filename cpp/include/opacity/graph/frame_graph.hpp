// The frame graph. Each frame declares its resources and passes anew, in order; what a name held in
// the frame before is kept. A pass runs when its output is needed and a declared read has moved;
// otherwise it is cached or culled.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "opacity/graph/device.hpp"
#include "opacity/graph/pass.hpp"
#include "opacity/graph/pass_context.hpp"
#include "opacity/graph/report.hpp"

namespace opacity {

class FrameGraph {
   public:
    explicit FrameGraph(Device& device) : device_{device} {}
    ~FrameGraph();
    FrameGraph(const FrameGraph&) = delete;
    FrameGraph& operator=(const FrameGraph&) = delete;

    // Else passes run in C++, and may keep in memory what suits them.
    bool runs_shaders() const { return device_.runs_shaders(); }
    // Starts the declarations of a frame.
    void begin();
    // Names declared while it lives start with "<name>/".
    class Scope {
       public:
        Scope(FrameGraph& graph, const std::string& name);
        ~Scope() { graph_.prefix_ = outer_; }

       private:
        FrameGraph& graph_;
        std::string outer_;
    };
    Texture& texture(const std::string& name, const TextureDesc& desc);
    // A texture or buffer that a pass resizes when it knows how much it needs.
    Texture& growing_texture(const std::string& name, Format format);
    Buffer& buffer(const std::string& name);
    // A value that a pass finds, or `initial` until then. The graph keeps it, so that a technique
    // holds nothing but its parameters, and may serve several renderers.
    template <class T>
    Value<T>& value(const std::string& name, T initial) {
        const std::string full_name = prefix_ + name;
        declared_.insert(full_name);
        std::unique_ptr<Source>& slot = values_[full_name];
        if (!dynamic_cast<Value<T>*>(slot.get()))
            slot = std::make_unique<Value<T>>(full_name, std::move(initial));
        return static_cast<Value<T>&>(*slot);
    }
    void add(Pass pass);

    // Runs what the goals need. If a pass throws, it and all after it stay to be run.
    using Goals = std::vector<const Resource*>;
    void run(const Goals& goals);
    void run(const Resource& goal) { run(Goals{&goal}); }
    // Called before each pass that runs; may throw to stop the frame, which then goes on where it
    // was.
    void set_interrupt_check(std::function<void()> check) { interrupt_check_ = std::move(check); }
    // Forgets every cached result.
    void invalidate() { records_.clear(); }

    const Report& report() const noexcept { return report_; }
    // Every texture and buffer that the goals of the last run needed, by name.
    std::vector<ResourceMemory> memory() const;
    // The last declarations as a Graphviz digraph.
    std::string graph_dot() const;
    // ParameterError that lists the names when there is none of this one.
    const Texture& find(const std::string& name) const;

   private:
    friend class PassContext;
    // What a pass read when it ran last.
    struct Read {
        std::string name;
        Revision revision;
        bool operator==(const Read&) const = default;
    };
    // What a pass was when it ran last: another shader or state is another result.
    struct Record {
        Shader shader;
        State state;
        std::vector<Target> writes;
        std::vector<Read> reads;
        std::string note;
        bool output_lost = false;

        bool same_input(const Record& other) const {
            return shader == other.shader && state == other.state && writes == other.writes &&
                   reads == other.reads;
        }
    };

    void check(const Pass& pass) const;
    std::set<const Source*> needed_for(const Goals& goals) const;
    std::vector<Read> reads_now(const Pass& pass) const;
    bool outputs_intact(const Pass& pass) const;
    bool allocated_as_described(const Texture& texture) const;
    void allocate(const Texture& texture);
    static std::string why_again(const Record& last, const Record& now);
    PassReport step(const Pass& pass, bool needed);
    std::string execute(const Pass& pass, bool clear_only);  // returns the pass's note
    static void run_on_cpu(const Pass& pass, PassContext& context);
    void drop_undeclared();

    Device& device_;
    std::string prefix_;
    std::vector<Pass> passes_;
    std::map<std::string, std::unique_ptr<Texture>> textures_;
    std::map<std::string, std::unique_ptr<Buffer>> buffers_;
    std::map<std::string, std::unique_ptr<Source>> values_;
    std::set<std::string> declared_;
    std::map<std::string, Record> records_;
    // The description that a texture's storage was made for; keyed by name.
    std::map<std::string, TextureDesc> allocated_;
    Revision shader_revision_ = 0;
    Report report_;
    std::set<std::string> needed_;  // names, since what they belong to may be dropped
    std::function<void()> interrupt_check_;
};

}  // namespace opacity
