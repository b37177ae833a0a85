#pragma once

// Embree 4 of Debian 13 where it is installed, else Embree 3 of Debian 12, and the calls in which
// they differ. Only for sources that trace: its types go no further.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace belvedere {

// How rays are traced; coherent: bundles whose rays go about the same way.
class EmbreeQuery {
 public:
#if RTC_VERSION_MAJOR >= 4
  EmbreeQuery(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitIntersectArguments(&nearest_);
    rtcInitOccludedArguments(&any_);
    if (coherent) nearest_.flags = any_.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  }
  void intersect(RTCRayHit& ray) { rtcIntersect1(scene_, &ray, &nearest_); }
  void intersect(const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene_, &rays, &nearest_);
  }
  void occluded(const int* valid, RTCRay16& rays) { rtcOccluded16(valid, scene_, &rays, &any_); }

 private:
  RTCIntersectArguments nearest_;
  RTCOccludedArguments any_;
#else
  EmbreeQuery(RTCScene scene, bool coherent) : scene_(scene) {
    rtcInitIntersectContext(&context_);
    if (coherent) context_.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  }
  void intersect(RTCRayHit& ray) { rtcIntersect1(scene_, &context_, &ray); }
  void intersect(const int* valid, RTCRayHit16& rays) {
    rtcIntersect16(valid, scene_, &context_, &rays);
  }
  void occluded(const int* valid, RTCRay16& rays) {
    rtcOccluded16(valid, scene_, &context_, &rays);
  }

 private:
  RTCIntersectContext context_;
#endif
  RTCScene scene_;
};

}  // namespace belvedere
