#include "collision/shapes/facets.hpp"

#include <libqhull_r/qhull_ra.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace saltus {
namespace {

/// Where Qhull writes; it would use stderr otherwise.
class Messages {
 public:
  Messages() : file_(std::tmpfile()) {}
  ~Messages() {
    if (file_ != nullptr) std::fclose(file_);
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;

  std::FILE* file() { return file_ == nullptr ? stderr : file_; }

  /// The first line, "QH6154 qhull precision error: Initial simplex is flat ...".
  std::string first_line() {
    char line[200] = "";
    if (file_ == nullptr) return "an error";
    std::rewind(file_);
    while (std::fgets(line, sizeof line, file_) != nullptr) {
      std::string text = line;
      text.erase(std::min(text.find('\n'), text.size()));
      if (!text.empty()) return text;
    }
    return "an error without a message";
  }

 private:
  std::FILE* file_;
};

/// Qhull's state, freed at the end.
class Qhull {
 public:
  Qhull() : qh_(std::make_unique<qhT>()) { qh_zero(qh_.get(), messages.file()); }
  ~Qhull() {
    qh_freeqhull(qh_.get(), qh_ALL);
    int still_used = 0, total = 0;
    qh_memfreeshort(qh_.get(), &still_used, &total);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  qhT* get() { return qh_.get(); }

  Messages messages;

 private:
  std::unique_ptr<qhT> qh_;
};

std::vector<int> corners_of(qhT* qh, facetT* facet, const std::vector<Vec3>& points) {
  std::vector<int> corners;
  setT* ring = qh_facet3vertex(qh, facet);  // in order around the facet, one way or the other
  for (int i = 0; i < qh_setsize(qh, ring); ++i) {
    auto* const vertex = static_cast<vertexT*>(ring->e[i].p);
    corners.push_back(qh_pointid(qh, vertex->point));
  }
  qh_settempfree(qh, &ring);
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Vec3& origin = points[corners[0]];
    area += (points[corners[i]] - origin).cross(points[corners[i + 1]] - origin);
  }
  const Vec3 outward(facet->normal[0], facet->normal[1], facet->normal[2]);
  if (area.dot(outward) < 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace

Facets hull_facets(const std::vector<Vec3>& points, double thickness) {
  std::vector<double> coordinates;
  for (const Vec3& p : points) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
  // C-: facets that are not convex by this much at their middles are joined; Pp: no advice
  char command[64];
  std::snprintf(command, sizeof command, "qhull C-%.3g Pp", thickness);
  Qhull qhull;
  qhT* const qh = qhull.get();
  const int error = qh_new_qhull(qh, 3, static_cast<int>(points.size()), coordinates.data(), False,
                                 command, nullptr, qhull.messages.file());
  if (error != 0) return {{}, qhull.messages.first_line()};
  Facets facets;
  for (facetT* facet = qh->facet_list; facet != nullptr && facet->next != nullptr;
       facet = facet->next) {
    facets.corners.push_back(corners_of(qh, facet, points));
  }
  return facets;
}

}  // namespace saltus
