// Marks in the stencil: no colour.
void main() {}
