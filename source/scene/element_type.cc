#include <vibrocontact/scene/element_type.h>

#include <map>

namespace vibrocontact
{
  const ElementType *element_type(const unsigned int number)
  {
    static const std::map<unsigned int, ElementType> types = {
        {1, {2, 1, 1, "lines", 2}},
        {2, {3, 2, 1, "triangles", 3}},
        {3, {4, 2, 1, "quadrilaterals", 4}},
        {4, {4, 3, 1, "tetrahedra", 4}},
        {5, {8, 3, 1, "hexahedra", 8}},
        {6, {6, 3, 1, "prisms", 6}},
        {7, {5, 3, 1, "pyramids", 5}},
        {8, {3, 1, 2, "second-order lines", 2}},
        {9, {6, 2, 2, "second-order triangles", 3}},
        {10, {9, 2, 2, "second-order quadrilaterals", 4}},
        {11, {10, 3, 2, "second-order tetrahedra", 4}},
        {12, {27, 3, 2, "second-order hexahedra", 8}},
        {13, {18, 3, 2, "second-order prisms", 6}},
        {14, {14, 3, 2, "second-order pyramids", 5}},
        {15, {1, 0, 1, "points", 1}},
        {16, {8, 2, 2, "second-order quadrilaterals of 8 nodes", 4}},
        {17, {20, 3, 2, "second-order hexahedra of 20 nodes", 8, 12}},
        {18, {15, 3, 2, "second-order prisms of 15 nodes", 6, 13}},
        {19, {13, 3, 2, "second-order pyramids of 13 nodes", 5}}};
    const auto found = types.find(number);
    return found == types.end() ? nullptr : &found->second;
  }

  std::vector<std::vector<unsigned int>> middles(const unsigned int number)
  {
    using Lists = std::vector<std::vector<unsigned int>>;
    const Lists hexahedron = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                              {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
                prism = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
                pyramid = {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
    const auto with = [](Lists edges, const Lists &more)
    {
      edges.insert(edges.end(), more.begin(), more.end());
      return edges;
    };
    switch (number)
    {
    case 11:
      return {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}};
    case 12:
      return with(hexahedron, {{0, 3, 2, 1},
                               {0, 1, 5, 4},
                               {0, 4, 7, 3},
                               {1, 2, 6, 5},
                               {2, 3, 7, 6},
                               {4, 5, 6, 7},
                               {0, 1, 2, 3, 4, 5, 6, 7}});
    case 13:
      return with(prism, {{0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}});
    case 14:
      return with(pyramid, {{0, 3, 2, 1}});
    case 17:
      return hexahedron;
    case 18:
      return prism;
    case 19:
      return pyramid;
    default:
      return {};
    }
  }
} // namespace vibrocontact
