// Compresses T along the light into nodes that straight lines join, within a bound (Lokovic and
// Veach 2000, section 3.2). From the last node on, the slopes are kept whose line passes all vertices
// since then within the bound; a vertex that leaves none ends the line at the one before, in the
// middle of them. Include it after
//     void keep(float depth, float transmittance)
//     bool keeps_none()
// C++: map/transmittance_line.hpp.

struct Line {
    float node_depth, node_transmittance;
    float steepest, flattest;  // slopes, never rising
    float depth, low, high;    // of the last vertex: where it is, and where T may be there
};

Line line;

void start_line(float depth, float transmittance) {
    line = Line(depth, transmittance, -1e30, 0.0, depth, transmittance, transmittance);
}

// False, and nothing else, if no line reaches this vertex too.
bool extend_line(float depth, float low, float high) {
    float run = depth - line.node_depth;
    float steepest = max(line.steepest, min((low - line.node_transmittance) / run, 0.0));
    float flattest = min(line.flattest, (high - line.node_transmittance) / run);
    if (steepest > flattest) return false;
    bool again = depth == line.depth;  // a step: both of its sides count
    line.low = again ? max(line.low, low) : low;
    line.high = again ? min(line.high, high) : high;
    line.steepest = steepest;
    line.flattest = flattest;
    line.depth = depth;
    return true;
}

// T = 1 in front of the first node, which need not be told.
void add_node(float depth, float transmittance) {
    if (keeps_none() && depth > line.node_depth) keep(line.node_depth, line.node_transmittance);
    keep(depth, transmittance);
    start_line(depth, transmittance);
}

void end_line() {
    if (!(line.depth > line.node_depth)) return;
    float slope = 0.5 * (line.steepest + line.flattest);
    float there = line.node_transmittance + slope * (line.depth - line.node_depth);
    add_node(line.depth, clamp(there, line.low, line.high));
}

// A vertex at which T may be from `low` to `high`; `transmittance` is what it is.
void add_vertex(float depth, float transmittance, float low, float high) {
    if (depth > line.node_depth && !extend_line(depth, low, high)) {
        end_line();
        if (depth > line.node_depth) extend_line(depth, low, high);
    }
    if (!(depth > line.node_depth) && line.node_transmittance > high) add_node(depth, transmittance);
}
