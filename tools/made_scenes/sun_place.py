"""Where the sun stands, for a place and a time: J. Meeus, Astronomical Algorithms (2nd ed.),
chapter 25, lower accuracy (0.01 degrees), without the parallax (0.002 degrees). Independent of the
program that the recordings judge."""
import math
from datetime import datetime, timezone


def refraction_deg(true_elevation_deg):
    """Saemundsson's refraction (Meeus, eq. 16.4) at 1010 hPa and 10 degrees Celsius."""
    angle = true_elevation_deg + 10.3 / (true_elevation_deg + 5.11)
    return 1.02 / 60.0 / math.tan(math.radians(angle))


def sun_place_deg(latitude_deg, longitude_deg, utc):
    """Azimuth (clockwise from true north) and elevation as seen, in degrees. `utc`: RFC 3339, Z."""
    moment = datetime.strptime(utc, "%Y-%m-%dT%H:%M:%SZ").replace(tzinfo=timezone.utc)
    days = moment.timestamp() / 86400.0 + 2440587.5 - 2451545.0
    t = (days + 69.0 / 86400.0) / 36525.0  # TT is 69 s ahead of UTC.
    mean_longitude = 280.46646 + 36000.76983 * t  # (25.2)
    anomaly = math.radians(357.52911 + 35999.05029 * t)  # (25.3)
    centre = (
        (1.914602 - 0.004817 * t) * math.sin(anomaly)
        + 0.019993 * math.sin(2 * anomaly)
        + 0.000289 * math.sin(3 * anomaly)
    )
    node = math.radians(125.04 - 1934.136 * t)
    apparent = math.radians(mean_longitude + centre - 0.00569 - 0.00478 * math.sin(node))
    obliquity = math.radians(23.439291 - 0.0130042 * t + 0.00256 * math.cos(node))  # (25.8)
    ascension = math.atan2(math.cos(obliquity) * math.sin(apparent), math.cos(apparent))
    declination = math.asin(math.sin(obliquity) * math.sin(apparent))
    sidereal_deg = 280.46061837 + 360.98564736629 * days  # (12.4)
    hour_angle = math.radians(sidereal_deg + longitude_deg) - ascension
    latitude = math.radians(latitude_deg)
    elevation = math.asin(
        math.sin(latitude) * math.sin(declination)
        + math.cos(latitude) * math.cos(declination) * math.cos(hour_angle)
    )
    azimuth = math.pi + math.atan2(
        math.sin(hour_angle),
        math.cos(hour_angle) * math.sin(latitude) - math.tan(declination) * math.cos(latitude),
    )
    elevation_deg = math.degrees(elevation)
    return math.degrees(azimuth) % 360.0, elevation_deg + refraction_deg(elevation_deg)


def in_marker_frame(azimuth_deg, elevation_deg, heading_deg):
    """Unit vector towards a compass direction, where the marker lies face up and its y axis points
    to the azimuth `heading_deg`."""
    turn, up = math.radians(azimuth_deg - heading_deg), math.radians(elevation_deg)
    return (math.cos(up) * math.sin(turn), math.cos(up) * math.cos(turn), math.sin(up))
