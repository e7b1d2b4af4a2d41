// What the sketch of a ROS 2 node stands in: the fields that it uses of std_msgs, vision_msgs 4 and rclcpp.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gentrack2.hpp"

namespace std_msgs::msg {
struct Stamp {
    std::int32_t sec = 0;
    std::uint32_t nanosec = 0;
};
struct Header {
    Stamp stamp;
    std::string frame_id;
};
} // namespace std_msgs::msg

namespace vision_msgs::msg {
struct Point2D {
    double x = 0, y = 0;
};
struct Pose2D {
    Point2D position;
    double theta = 0;
};
struct BoundingBox2D {
    Pose2D center;
    double size_x = 0, size_y = 0;
};
struct ObjectHypothesis {
    std::string class_id;
    double score = 0;
};
struct ObjectHypothesisWithPose {
    ObjectHypothesis hypothesis;
};
struct Detection2D {
    std_msgs::msg::Header header;
    std::vector<ObjectHypothesisWithPose> results;
    BoundingBox2D bbox;
    std::string id;
};
struct Detection2DArray {
    std_msgs::msg::Header header;
    std::vector<Detection2D> detections;
};
} // namespace vision_msgs::msg

template <class Message> struct Publisher {
    void publish(const Message &message);
};

@BLOCK@
