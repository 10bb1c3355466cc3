package roomwise.spy;

import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.event.ActionEvent;
import java.awt.image.BufferedImage;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JComponent;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import javax.swing.Timer;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;
import roomwise.kinect_frame_t;

/** Shows KINECT_FRAME: right-click its row in lcm-spy, "Depth and colour". */
public final class FrameView implements SpyPlugin {
    /** Pictures drawn since the start, for scripts/spy --check. */
    static volatile int drawn;

    @Override
    public boolean canHandle(long fingerprint) {
        return fingerprint == kinect_frame_t.LCM_FINGERPRINT;
    }

    @Override
    public Action getAction(JDesktopPane desktop, ChannelData channel) {
        return new AbstractAction("Depth and colour") {
            @Override
            public void actionPerformed(ActionEvent event) {
                open(channel);
            }
        };
    }

    static JFrame open(ChannelData channel) {
        Pictures pictures = new Pictures(channel);
        JFrame window = new JFrame(channel.name + ": depth (red 0.5 m to blue 6 m) and colour");
        window.add(pictures);
        window.pack();
        window.setVisible(true);
        Timer timer = new Timer(50, event -> pictures.update());
        timer.start();
        window.addWindowListener(new java.awt.event.WindowAdapter() {
            @Override
            public void windowClosing(java.awt.event.WindowEvent event) {
                timer.stop();
            }
        });
        return window;
    }

    private static final class Pictures extends JComponent {
        private final ChannelData channel;
        private Object shown;
        private BufferedImage depth;
        private BufferedImage color;
        private String trouble = "waiting for a frame";

        Pictures(ChannelData channel) {
            this.channel = channel;
            setPreferredSize(new Dimension(1280, 480));
        }

        void update() {
            Object newest = channel.last;
            if (newest == shown || !(newest instanceof kinect_frame_t)) return;
            shown = newest;
            try {
                kinect_frame_t frame = (kinect_frame_t) newest;
                depth = FramePictures.depth(frame);
                color = FramePictures.color(frame);
                trouble = "";
                drawn++;
            } catch (Exception error) {
                trouble = error.toString();  // whatever a sender puts into a frame, the window stays
            }
            repaint();
        }

        @Override
        protected void paintComponent(Graphics graphics) {
            int half = getWidth() / 2;
            graphics.setColor(Color.DARK_GRAY);
            graphics.fillRect(0, 0, getWidth(), getHeight());
            graphics.drawImage(depth, 0, 0, half, getHeight(), null);
            graphics.drawImage(color, half, 0, half, getHeight(), null);
            graphics.setColor(Color.WHITE);
            graphics.drawString(trouble, 10, 20);
        }
    }
}
