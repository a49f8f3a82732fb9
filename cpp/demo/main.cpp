// opacity_demo: the same picture from C++ as `pyopacity render` makes, in a window or without one.
#include <cstdio>
#include <exception>
#include <new>
#include <sstream>
#include <string>

#include "options.hpp"
#include "viewer.hpp"

namespace {

using namespace opacity;

enum ExitCode { success = 0, bad_input = 2, no_context = 3, no_memory = 4 };

void render_headless(const demo::Options& options) {
    const demo::Stage stage = demo::load_stage(options);
    Renderer renderer = demo::make_renderer(options, stage, nullptr);
    const Image image = renderer.render();
    save_png(options.output, image);
    std::printf("%s%s: %dx%d on %s\n", to_string(renderer.report()).c_str(), options.output.c_str(),
                image.width, image.height, renderer.context().renderer().c_str());
}

int run(int count, char** arguments) {
    const demo::Options options = demo::parse(count, arguments);
    if (options.help)
        std::fputs(demo::usage, stdout);
    else if (options.headless)
        render_headless(options);
    else
        demo::Viewer{options, demo::load_stage(options)}.run();
    return success;
}

// An error that lists what was tried has a line for each: here all of it is one.
int fail(const Error& error, int code) {
    std::istringstream words{error.problem() + "; fix: " + error.fix()};
    std::string line = "opacity_demo:";
    for (std::string word; words >> word;) line += " " + word;
    std::fprintf(stderr, "%s\n", line.c_str());
    return code;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        return run(count, arguments);
    } catch (const OutOfMemoryError& error) {
        return fail(error, no_memory);
    } catch (const ContextError& error) {
        return fail(error, no_context);
    } catch (const Error& error) {
        return fail(error, bad_input);
    } catch (const std::bad_alloc&) {
        return fail(OutOfMemoryError("no memory is left", "use a smaller scene, map or picture"),
                    no_memory);
    } catch (const std::exception& error) {
        return fail(Error(error.what(), "look at the files, their permissions and their disk"),
                    bad_input);
    }
}
