package roomwise.spy;

import java.awt.Rectangle;
import java.awt.Robot;
import java.awt.Toolkit;
import java.awt.image.BufferedImage;
import java.io.File;
import java.lang.reflect.Field;
import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;
import javax.imageio.ImageIO;
import javax.swing.JFrame;
import javax.swing.SwingUtilities;
import lcm.spy.ChannelData;
import lcm.spy.Spy;
import lcm.spy.SpyPlugin;

/** scripts/spy --check: are all types known, is the picture drawn? Arguments: URL, screenshot, channels. */
public final class Check {
    private static final int PATIENCE_MS = 30_000;

    private Check() {}

    public static void main(String[] arguments) throws Exception {
        Spy spy = new Spy(arguments[0]);
        Set<String> wanted = new HashSet<>(List.of(arguments).subList(2, arguments.length));
        ChannelData frames = null;
        long end = System.currentTimeMillis() + PATIENCE_MS;
        while (!wanted.isEmpty() && System.currentTimeMillis() < end) {
            for (ChannelData channel : new ArrayList<>(channelsOf(spy))) {
                if (channel.cls != null && channel.last != null && wanted.remove(channel.name)) {
                    System.out.println("spy: " + channel.name + " is " + channel.cls.getName());
                }
                if (channel.name.equals("KINECT_FRAME")) frames = channel;
            }
            Thread.sleep(100);
        }
        require(wanted.isEmpty(), "no type or no message for " + wanted);
        require(hasPlugin(spy), "lcm-spy did not find the plugin for KINECT_FRAME");
        lookAt(frames, arguments[1]);
        System.exit(0);
    }

    private static void lookAt(ChannelData frames, String screenshot) throws Exception {
        JFrame[] window = new JFrame[1];
        SwingUtilities.invokeAndWait(() -> {
            window[0] = FrameView.open(frames);
            window[0].setLocation(0, 380);
        });
        long end = System.currentTimeMillis() + PATIENCE_MS;
        while (FrameView.drawn < 5 && System.currentTimeMillis() < end) Thread.sleep(50);
        require(FrameView.drawn >= 5, "no frame was drawn");
        Thread.sleep(300);
        Robot robot = new Robot();
        Rectangle screen = new Rectangle(Toolkit.getDefaultToolkit().getScreenSize());
        ImageIO.write(robot.createScreenCapture(screen), "png", new File(screenshot));
        Rectangle inside = window[0].getContentPane().getBounds();
        inside.setLocation(window[0].getContentPane().getLocationOnScreen());
        int colors = colorsIn(robot.createScreenCapture(inside));
        require(colors > 500, "the picture has only " + colors + " colours");
        System.out.println("spy: KINECT_FRAME drawn in " + colors + " colours");
    }

    @SuppressWarnings("unchecked")
    private static List<ChannelData> channelsOf(Spy spy) throws Exception {
        return (List<ChannelData>) field(spy, "channelList");
    }

    @SuppressWarnings("unchecked")
    private static boolean hasPlugin(Spy spy) throws Exception {
        List<SpyPlugin> plugins = (List<SpyPlugin>) field(spy, "plugins");
        return plugins.stream().anyMatch(plugin -> plugin instanceof FrameView);
    }

    private static Object field(Spy spy, String name) throws Exception {
        Field field = Spy.class.getDeclaredField(name);
        field.setAccessible(true);
        return field.get(spy);
    }

    private static int colorsIn(BufferedImage picture) {
        Set<Integer> colors = new HashSet<>();
        for (int y = 0; y < picture.getHeight(); y += 2) {
            for (int x = 0; x < picture.getWidth(); x += 2) colors.add(picture.getRGB(x, y));
        }
        return colors.size();
    }

    private static void require(boolean holds, String otherwise) {
        if (holds) return;
        System.err.println("spy: " + otherwise);
        System.exit(1);
    }
}
