// What the loops of docs/migration stand in that are about one image.
#include <vector>

#include "gentrack2.hpp"

struct Box {
    float x, y, w, h, score;
    int label;
};
struct Image;

std::vector<Box> detect(const Image &image);
void draw(std::uint64_t id, double left, double top, double width, double height);

void fragment(const Image &image);

void fragment(const Image &image) {
@BLOCK@
}
