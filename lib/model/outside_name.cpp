#include "model/outside.hpp"

namespace coordreq {

const char* outside_name(Outside rule) {
  switch (rule) {
    case Outside::unsafe:
      return "unsafe";
    case Outside::safe:
      return "safe";
    case Outside::saturate:
      return "saturate";
    case Outside::stop:
      return "stop";
    case Outside::goal:
      return "goal";
    case Outside::periodic:
      return "periodic";
  }
  return "";
}

}  // namespace coordreq
