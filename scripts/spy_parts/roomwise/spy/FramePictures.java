package roomwise.spy;

import java.awt.Color;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import javax.imageio.ImageIO;
import roomwise.kinect_frame_t;

/** The two pictures of a KINECT_FRAME. */
final class FramePictures {
    private static final double NEAR_M = 0.5;
    private static final double FAR_M = 6.0;

    private FramePictures() {}

    /** Depth by hue, red near to blue far; black where there is no reading. */
    static BufferedImage depth(kinect_frame_t frame) {
        int width = frame.depth_width_px;
        int height = frame.depth_height_px;
        int[] steps = frame.depth_encoding == kinect_frame_t.DEPTH_PDZ16
                ? DepthDecoder.decode(frame.depth_data, width, height) : raw(frame);
        BufferedImage picture = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
        for (int i = 0; i < steps.length; i++) {
            if (steps[i] == 0) continue;
            double share = (steps[i] * frame.depth_unit_m - NEAR_M) / (FAR_M - NEAR_M);
            float hue = (float) (0.7 * Math.max(0.0, Math.min(1.0, share)));
            picture.setRGB(i % width, i / width, Color.HSBtoRGB(hue, 1.0f, 1.0f));
        }
        return picture;
    }

    /** Null where the frame has none. */
    static BufferedImage color(kinect_frame_t frame) throws IOException {
        if (frame.color_encoding == kinect_frame_t.COLOR_JPEG) {
            return ImageIO.read(new ByteArrayInputStream(frame.color_data));
        }
        if (frame.color_encoding != kinect_frame_t.COLOR_RGB8) return null;
        int width = frame.color_width_px;
        BufferedImage picture =
                new BufferedImage(width, frame.color_height_px, BufferedImage.TYPE_INT_RGB);
        byte[] rgb = frame.color_data;
        for (int i = 0; 3 * i + 2 < rgb.length; i++) {
            picture.setRGB(i % width, i / width, (rgb[3 * i] & 0xff) << 16
                    | (rgb[3 * i + 1] & 0xff) << 8 | rgb[3 * i + 2] & 0xff);
        }
        return picture;
    }

    /** Bits of a pixel's word below its depth: DEPTH_PLAYER16 has a player's index there. */
    private static int bitsBelow(kinect_frame_t frame) {
        if (frame.depth_encoding == kinect_frame_t.DEPTH_RAW16) return 0;
        if (frame.depth_encoding == kinect_frame_t.DEPTH_PLAYER16) return 3;
        throw new IllegalArgumentException("unknown depth encoding " + frame.depth_encoding);
    }

    private static int[] raw(kinect_frame_t frame) {
        int[] steps = new int[frame.depth_width_px * frame.depth_height_px];
        ByteBuffer data = ByteBuffer.wrap(frame.depth_data).order(ByteOrder.LITTLE_ENDIAN);
        int below = bitsBelow(frame);
        for (int i = 0; i < steps.length; i++) steps[i] = (data.getShort(2 * i) & 0xffff) >> below;
        return steps;
    }
}
