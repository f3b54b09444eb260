#version 450 core
// Which triangle of a real surface a sample of the picture shows: its number in the table of
// compositor/triangle_table.h, from 1 on. 0: nothing that changes.

uniform int u_first_id;
uniform int u_step;  // 1; 0 where a whole draw is one number.

layout(location = 0) out uint out_id;

void main() { out_id = uint(u_first_id + u_step * gl_PrimitiveID); }
