// Depths alone.
void main() {}
